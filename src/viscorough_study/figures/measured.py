"""Draw measured surfaces in comparison with generated discs."""

import numpy as np

from viscorough_study.ensembles.mean_curve import mean_curve
from viscorough_study.figures import style
from viscorough_study.fits.conventions import fits

_LINES = ("-", "--", ":", "-.", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 3)))


@style.figure
def plot_measured(groups, discs, scaling, kinetics, conventions, *, fraction_min):
    """Draw vt/h of measured and generated surfaces against X (a), and the depth against time under given forces (b).

    groups : {name of a group of scans: its ensemble dataset}
    discs : ensemble datasets of generated discs, one for each Hurst exponent
    scaling, kinetics : tables measured_fits and measured_kinetics of comparisons.measured; kinetics may be empty
    conventions : choices that the paper leaves open, {column of the table of fits: value}
    fraction_min : a mean is drawn if at least this fraction of the discs has a value
    """
    figure, (law, motion) = style.new_subplots(85, 1, 2)
    looks, hursts = style.series_looks(groups), style.hurst_looks(ds["hurst"].item() for ds in discs)
    for ds in discs:
        curve, look = mean_curve(ds, conventions, fraction_min), hursts[ds["hurst"].item()]
        look = look | {"marker": "", "linewidth": 0.7, "alpha": 0.6}
        law.plot(curve.x[curve.several], curve.velocity[curve.several], **look)
    for name, group in groups.items():
        color, x = looks[name]["color"], group["x"].values
        for velocity, count in zip(group["velocity"].values[0], group["contact_count"].values[0], strict=True):
            law.plot(x[count > 1], velocity[count > 1], color=color, linewidth=0.9)
        own_rms = {"rms_convention": "disc", "source": "measured", "group": name}
        for row in fits(scaling, conventions, **own_rms).itertuples():
            window = np.array([row.x_low, row.x_high])
            law.plot(window, window**row.beta / row.zeta, color=color, linewidth=3, alpha=0.4)
    law.set(xscale="log", yscale="log", xlabel=r"$X = Ft/(4\eta hL)$", ylabel="$vt/h$")
    law.set_title("(a) dimensionless velocity")
    media = dict(zip(dict.fromkeys(kinetics["medium"]), _LINES, strict=False))
    for (_, group, medium, _), rows in kinetics.groupby(["scan", "group", "medium", "force"]):
        look = {"color": looks[group]["color"], "linestyle": media[medium], "linewidth": 0.9}
        motion.plot(rows["time"], rows["depth"] * 1e6, **look)
    forces = ", ".join(f"{force:g}" for force in sorted(set(kinetics["force"])))
    title = f"(b) depth under {forces} N" if forces else "(b) depth: no forces were given"
    motion.set(xlabel="time $t$ (s)", ylabel="depth $u$ (µm)", title=title)
    if len(kinetics):
        motion.set(xscale="log", yscale="log")
    grey = {"color": style.GREY, "linewidth": 0.9}
    handles = [
        *(style.handle(name.replace("_", " "), color=looks[name]["color"]) for name in groups),
        *style.hurst_handles(hursts, marker="", linewidth=0.7, alpha=0.6),
        style.handle("power law, region (b)", color=style.GREY, linewidth=3, alpha=0.4),
        *(style.handle(name.replace("_", " "), linestyle=line, **grey) for name, line in media.items()),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=5)
    return figure
