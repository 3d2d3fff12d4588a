"""Press a sphere into a standard linear solid; compare the exact solution. Makes sphere_in_a_solid.png.

    python examples/sphere_in_a_solid.py

Lee and Radok: u^(3/2) = 3 F J(t)/(16 √R) with the creep compliance J(t) of the medium. The solid responds elastically
at t = 0 with its instantaneous modulus, and creeps to the depth of its relaxed modulus.
"""

import matplotlib.pyplot as plt
import numpy as np

import viscorough

radius, force = 1e-2, 0.5  # m, N
solid = viscorough.StandardLinearSolid(instantaneous_modulus=10e6, relaxed_modulus=1e6, relaxation_time=0.1)  # Pa, s
times = np.geomspace(1e-3, 100, 60)
exact = (3 * force * solid.creep_compliance(times) / (16 * np.sqrt(radius))) ** (2 / 3)

position = np.linspace(-1, 1, 129) * 1.3 * np.sqrt(radius * exact[-1])  # slightly more than the last contact
heights = -(position[:, None] ** 2 + position**2) / (2 * radius)
sphere = viscorough.Indenter(heights, position[1] - position[0])
curve = viscorough.indent(sphere, until_force=1.01 * force / 1e6, tolerance=1e-4)
motion = viscorough.kinetics(curve, force, solid, times)
error = np.abs(motion.depth / exact - 1).max()

figure, axes = plt.subplots(figsize=(4, 3), layout="constrained")
axes.semilogx(times, 1e6 * exact, "C0", label="Lee and Radok")
axes.semilogx(times[::4], 1e6 * motion.depth[::4], "C1o", label="boundary elements")
axes.set(xlabel="time (s)", ylabel="depth (µm)")
axes.legend()
figure.savefig("sphere_in_a_solid.png", dpi=80)
