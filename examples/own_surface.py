"""Penetration of a measured map of heights into a viscous medium. Makes own_surface.png.

    python examples/own_surface.py

The lines are those of README.md: first they make a map, a ball of radius 2 mm with a self-affine roughness of 0.2 µm.
"""

import matplotlib.pyplot as plt
import numpy as np

import viscorough

disc = viscorough.self_affine_disc(0.8, 257, rms=2e-7, diameter=257e-6, seed=1)
x = 1e-6 * (np.arange(257) - 128)
np.save("heights.npy", disc.heights - (x[:, None] ** 2 + x**2) / 4e-3)  # a rough ball, or heights of your own

surface = viscorough.read_heights("heights.npy", spacing=1e-6)  # in metres; larger is higher; nan is outside
curve = viscorough.indent(surface, tolerance=1e-3, until_fraction=0.5)
motion = viscorough.kinetics(curve, force=0.5, medium=1e9)  # 0.5 N on a medium of 1e9 Pa s
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
figure.colorbar(left.imshow(surface.heights * 1e6), label="height (µm)")
right.loglog(motion.time, motion.depth * 1e6)
right.set(xlabel="time (s)", ylabel="depth (µm)", xlim=(1e-6, 10), ylim=(1e-4, 10))
figure.savefig("own_surface.png")
