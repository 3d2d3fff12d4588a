"""The method of dimensionality reduction (MDR) against boundary elements: stiffness over force. Makes reduction.png.

    python examples/reduction.py

Lines of independent springs with H = 0.7 stand in for discs of the same Hurst exponent and rms height. The means agree
to some tens of percent, over decades of force. A single line says nothing about a single disc.
"""

import matplotlib.pyplot as plt
import numpy as np

import viscorough

x = np.geomspace(3e-3, 0.5, 40)  # X = F/(4GhL); rms height h and diameter L are 1


def stiffness(curves):
    """κ = k/(4GL) of every curve at X, from the levels of the curve."""
    return np.array([curve.at_force(4 * x)[1] / 4 for curve in curves])


discs = [viscorough.self_affine_disc(0.7, 65, seed=seed) for seed in range(10)]
lines = [viscorough.self_affine_line(0.7, 16384, seed=seed) for seed in range(10)]
elements = stiffness([viscorough.indent(disc, until_force=2.1) for disc in discs])
springs = stiffness([viscorough.reduce(line) for line in lines])
ratio = np.mean(springs, axis=0)[20] / np.mean(elements, axis=0)[20]  # at the middle of the range

figure, axes = plt.subplots(figsize=(4, 3), layout="constrained")
for curves, color, name in ((elements, "C0", "boundary elements"), (springs, "C1", "MDR")):
    axes.loglog(x, curves.T, color, linewidth=0.4, alpha=0.5)
    axes.loglog(x, np.mean(curves, axis=0), color, linewidth=2, label=f"{name}, mean")
axes.set(xlabel="force $X = F/(4GhL)$", ylabel="stiffness $k/(4GL)$")
axes.legend()
figure.savefig("reduction.png", dpi=80)
