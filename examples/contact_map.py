"""Compute a map of the contact of your own scan at a given force. Makes contact_map.png.

    python examples/contact_map.py

If there is no file scan.npy, the example first makes one: a rough plate of 0.2 mm with a bump in its middle.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import viscorough


def rough_plate(points=129, spacing=1.6e-6):
    """Return heights [m] of a self-affine plate of rms height 0.3 µm on a shallow bump."""
    disc = viscorough.self_affine_disc(0.8, 2 * points, rms=3e-7, diameter=4e-4, roll_off_wavelength=0.1, seed=4)
    position = spacing * (np.arange(points) - points // 2)
    middle = slice(points // 2, points // 2 + points)
    return disc.heights[middle, middle] - (position[:, None] ** 2 + position**2) / (2 * 3e-3)


if not Path("scan.npy").exists():
    np.save("scan.npy", rough_plate())

surface = viscorough.read_heights("scan.npy", spacing=1.6e-6)  # higher points touch first
modulus, force = 1e6, 1e-3  # shear modulus of the half-space [Pa], normal force [N]
contact = viscorough.contact_at(surface, force=force / modulus)
fraction, patches = contact.contact_fraction, contact.patches()

figure, (left, middle, right) = plt.subplots(1, 3, figsize=(10, 2.6), layout="constrained")
figure.colorbar(left.imshow(surface.heights * 1e6), label="height (µm)")
figure.colorbar(middle.imshow(contact.pressure * modulus / 1e3, cmap="inferno"), label="pressure (kPa)")
figure.colorbar(right.imshow(contact.gap * 1e6, cmap="cividis"), label="gap (µm)")
middle.set_title(f"{100 * fraction:.1f} % in contact, {patches.areas.size} patches", fontsize="medium")
figure.savefig("contact_map.png", dpi=64)
