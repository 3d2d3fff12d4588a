"""Press a rough punch into a polymer, a Prony series of three branches. Makes ramp_in_a_polymer.png.

    python examples/ramp_in_a_polymer.py

The force rises and then stays constant; the instantaneous modulus of the medium is ten times its relaxed modulus. The
dashed lines are the depths in elastic media with these two moduli. The punch creeps from one to the other over many
decades of time.
"""

import matplotlib.pyplot as plt
import numpy as np

import viscorough

polymer = viscorough.Prony(relaxed_modulus=1e6, moduli=[5e6, 3e6, 1e6], relaxation_times=[1e-2, 0.3, 10.0])  # Pa, s
times = np.concatenate([[0.0], np.geomspace(1e-3, 1e3, 300)])
force = 0.02 * np.minimum(times / 0.1, 1.0)  # N: a ramp of 0.1 s

punch = viscorough.self_affine_disc(0.8, 129, rms=1e-6, diameter=1e-2, seed=1)  # in metres
curve = viscorough.indent(punch, until_force=1.01 * 0.02 / 1e6)
motion = viscorough.kinetics(curve, force, polymer, times)
stiff, soft = (curve.at_force(force / modulus)[0] for modulus in (10e6, 1e6))
crept = motion.depth[-1] / motion.depth[np.argmin(np.abs(times - 0.1))]  # since the end of the ramp

figure, axes = plt.subplots(figsize=(4.4, 3), layout="constrained")
axes.semilogx(times, 1e6 * motion.depth, "C0", label="Prony series")
axes.semilogx(times, 1e6 * stiff, "0.4", times, 1e6 * soft, "0.4", linestyle="--")
axes.axvline(0.1, color="0.8", zorder=0)
axes.set(xlabel="time (s)", ylabel="depth (µm)", xlim=(1e-3, 1e3), ylim=(0, None))
axes.legend()
figure.savefig("ramp_in_a_polymer.png", dpi=80)
