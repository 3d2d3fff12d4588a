"""Compare the contact area of a rough map with Persson's theory, over the force. Makes contact_area.png.

    python examples/contact_area.py

Persson's theory gives A/A0 = erf(√2 p/(E* h')), with the mean pressure p = F/A0, E* = 4G and the rms slope h'. It
describes infinite surfaces, and is exact only at complete contact; simulations find larger areas at small forces. Here
the roughness reaches down to two spacings, and the area counts whole elements, which makes it larger still.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.special import erf

import viscorough

surface = viscorough.self_affine_disc(0.8, 257, rms=1e-7, diameter=1e-4, roll_off_wavelength=0.1, seed=1)
area = surface.elements * surface.spacing**2
pressure = np.geomspace(2e-3, 1.5, 30)  # p/(E* h')
curve = viscorough.indent(surface, forces=4 * area * surface.rms_slope * pressure, tolerance=1e-4)

smooth = np.geomspace(2e-3, pressure[-1], 200)
ratio = np.interp(0.05, pressure, curve.contact_fraction) / erf(np.sqrt(2) * 0.05)

figure, (left, right) = plt.subplots(1, 2, figsize=(7, 2.8), layout="constrained")
for axes in (left, right):
    axes.plot(pressure, curve.contact_fraction, "C0.-", label="boundary elements")
    axes.plot(smooth, erf(np.sqrt(2) * smooth), "C1--", label="Persson")
    axes.set(xlabel="$p/(E^* h')$", ylabel="contact fraction $A/A_0$")
right.set(xscale="log", yscale="log")
left.legend()
figure.savefig("contact_area.png", dpi=80)
