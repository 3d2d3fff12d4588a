"""Penetration of a measured map of heights into a viscous medium. Makes own_surface.png.

    python examples/own_surface.py

Without a file heights.npy it first makes one, a ball with a rough surface. The lines after that are those of README.md,
and the picture is docs/own_surface.png.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import viscorough


def rough_ball(points=257, spacing=1e-6):
    """Heights [m] of a ball of radius 2 mm with a self-affine roughness of 0.2 µm, on a round map; nan outside."""
    disc = viscorough.self_affine_disc(0.8, points, rms=2e-7, diameter=points * spacing, seed=1)
    position = spacing * (np.arange(points) - points // 2)
    return disc.heights - (position[:, None] ** 2 + position**2) / (2 * 2e-3)


if not Path("heights.npy").exists():
    np.save("heights.npy", rough_ball())

surface = viscorough.read_heights("heights.npy", spacing=1e-6)  # in metres; larger is higher; nan is outside
curve = viscorough.indent(surface, tolerance=1e-3, until_fraction=0.5)
motion = viscorough.kinetics(curve, force=0.5, medium=1e9)  # 0.5 N on a medium of 1e9 Pa s
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
figure.colorbar(left.imshow(surface.heights * 1e6), label="height (µm)")
right.loglog(motion.time, motion.depth * 1e6)
right.set(xlabel="time (s)", ylabel="depth (µm)", xlim=(1e-6, 10), ylim=(1e-4, 10))
figure.savefig("own_surface.png")
