"""Count contact patches and their areas at four forces. Makes patches.png.

    python examples/patches.py

Contact patches appear, grow and merge as the force rises: their number has a maximum, and in the end one patch covers
almost the whole contact. The smallest patches are single elements, a limit of the grid.
"""

import matplotlib.pyplot as plt
import numpy as np

import viscorough

surface = viscorough.self_affine_disc(0.7, 257, rms=1e-6, diameter=1e-3, roll_off_wavelength=0.2, seed=2)
forces = 4 * 1e-6 * 1e-3 * np.array([0.3, 1.5, 6.0, 20.0])  # F/G [m²], at X = F/(4GhL)
contacts = viscorough.contact_at(surface, force=forces)
found = [contact.patches() for contact in contacts]
numbers = [patches.areas.size for patches in found]

figure, panels = plt.subplot_mosaic("abcd;eeff", figsize=(9, 4.8), layout="constrained")
left, right = panels["e"], panels["f"]
for name, contact, patches in zip("abcd", contacts, found, strict=True):
    axes = panels[name]
    axes.imshow(np.ma.masked_equal(np.minimum(patches.labels, 12), 0), cmap="tab20", interpolation="nearest")
    axes.set(xticks=[], yticks=[], title=f"{100 * contact.contact_fraction:.0f} % in contact")
    areas = np.sort(patches.areas)[::-1] * 1e12
    left.loglog(areas, np.arange(1, areas.size + 1), label=f"F/G = {contact.force:.1g} m²")
left.set(xlabel="area (µm²)", ylabel="patches of this area or more")
left.legend(fontsize="small")
right.semilogx(forces, numbers, "o-")
right.set(xlabel="F/G (m²)", ylabel="number of patches")
figure.savefig("patches.png", dpi=64)
