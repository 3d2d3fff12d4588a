"""Compute a force curve on a polymer: approach, hold and retract at three speeds. Makes force_curve.png.

    python examples/force_curve.py

A rough tip is pressed into a standard linear solid and pulled back. The loop between approach and retract is the work
that the polymer dissipates; adhesion, which would make the force negative, is left out.
"""

import matplotlib.pyplot as plt
import numpy as np

import viscorough

tip = viscorough.self_affine_disc(0.8, 129, rms=2e-9, diameter=1e-6, seed=1)
position = tip.spacing * (np.arange(129) - 64)
tip = viscorough.Indenter(tip.heights - (position[:, None] ** 2 + position**2) / (2 * 5e-6), tip.spacing)
depth = 2e-8  # m
curve = viscorough.indent(tip, depths=np.geomspace(1e-4, 1, 120) * depth)
polymer = viscorough.StandardLinearSolid(instantaneous_modulus=3e6, relaxed_modulus=1e6, relaxation_time=0.1)  # Pa, s

figure, axes = plt.subplots(figsize=(4, 3), layout="constrained")
works = []
for duration in (0.01, 0.1, 1.0):  # duration of the approach in s
    corners = duration * np.array([0.0, 1.0, 1.5, 2.5])
    load = viscorough.Load(corners, depth=depth * np.array([0.0, 1.0, 1.0, 0.0]))
    motion = viscorough.kinetics(curve, load, polymer, np.linspace(0, corners[-1], 401))
    works.append(np.trapezoid(motion.force, motion.depth))
    axes.plot(1e9 * motion.depth, 1e9 * motion.force, label=f"{duration:g} s")
axes.set(xlabel="depth (nm)", ylabel="force (nN)")
axes.legend(title="approach in")
figure.savefig("force_curve.png", dpi=80)
