"""A rough punch under a force that rises for one second and then stays constant. Makes ramp.png.

    python examples/ramp.py

In a Newtonian medium only the impulse counts: the depth is that of the elastic contact at F/G = ∫F dt/η. The dashed
line is the same force applied at once.
"""

import matplotlib.pyplot as plt
import numpy as np

import viscorough

viscosity = 1e9  # Pa s
times = np.linspace(0.0, 3.0, 301)  # s
force = 10.0 * np.minimum(times, 1.0)  # N
impulse = 10.0 * 3.0  # N s, of the force applied at once

punch = viscorough.self_affine_disc(0.8, 129, rms=1e-6, diameter=1e-2, seed=1)  # in metres
curve = viscorough.indent(punch, until_force=1.01 * impulse / viscosity)
ramp = viscorough.kinetics(curve, force, viscosity, times)
step = viscorough.kinetics(curve, 10.0, viscosity, times[1:])
depth = 1e6 * ramp.depth[-1]  # µm, after three seconds

figure, (left, middle, right) = plt.subplots(1, 3, figsize=(8, 2.6), layout="constrained")
left.plot(times, force, "C0", times[[0, 0, -1]], [0, 10, 10], "C1--")
middle.plot(times, 1e6 * ramp.depth, "C0", step.time, 1e6 * step.depth, "C1--")
right.semilogy(times, 1e6 * ramp.velocity, "C0", step.time, 1e6 * step.velocity, "C1--")
left.set(xlabel="time (s)", ylabel="force (N)")
middle.set(xlabel="time (s)", ylabel="depth (µm)")
right.set(xlabel="time (s)", ylabel="velocity (µm/s)", ylim=(0.1, 10))
figure.savefig("ramp.png", dpi=80)
