"""Draw Figure 2 of the paper: kinetics of penetration, in SI units and in dimensionless variables."""

import numpy as np
from matplotlib.patheffects import withStroke

from viscorough import reference
from viscorough_study.ensembles.mean_curve import mean_curve
from viscorough_study.ensembles.pool import elements_across
from viscorough_study.figures import style
from viscorough_study.fits.conventions import fits
from viscorough_study.run.readable import readable

# Rows of the table below the panels, {parameter: (label, value of the label's unit in SI units)}.
QUANTITIES = {
    "force": ("$F$ (N)", 1.0),
    "viscosity": (r"$\eta$ (Pa s)", 1.0),
    "diameter": ("$L$ (mm)", 1e-3),
    "rms": ("$h$ (µm)", 1e-6),
}


@style.figure
def plot_kinetics(ensembles, combinations, scaling, conventions, *, fraction_min):
    """Draw vt/h against X (the paper's Figure 2), velocity against time in SI units, and a table of the parameters.

    Each ensemble has a Hurst exponent, and a combination of four parameters: force, viscosity, diameter and rms height.

    ensembles : ensemble datasets, one for each Hurst exponent and combination
    combinations : {name of the ensemble: force [N], viscosity [Pa s], diameter [m], rms [m]}
    scaling : table of fitted power laws, with the ends of region (b); conventions : {column of this table: value}
    fraction_min : a mean is drawn if at least this fraction of the realizations has a value

    The upper axis of the left panel is the abscissa of the paper. Region (a), with one element in contact, is grey;
    only its last decade is drawn. Bars at the bottom, with the Hurst exponent, mark region (b). Velocities in SI units
    are computed with the rms height of the combination. They are exact if the figure measures h in the same region of
    the surface as the generation of the surfaces, which set this height.
    """
    looks = style.hurst_looks(ds["hurst"].item() for ds in ensembles)
    figure = style.new_figure(112)
    above, below = figure.subfigures(2, 1, height_ratios=(4.6, 1))
    collapsed, raw = above.subplots(1, 2, width_ratios=(1.1, 1))
    curves = [mean_curve(ds, conventions, fraction_min) for ds in ensembles]
    start = min((curve.x[curve.several][0] for curve in curves if curve.several.any()), default=0) / 10
    ends = {}
    for ds, curve in zip(ensembles, curves, strict=True):
        case, look = ds["case"].item(), looks[ds["hurst"].item()] | {"marker": "", "linewidth": 0.8}
        force, viscosity, length, rms = (combinations[case][name] for name in ("force", "viscosity", "diameter", "rms"))
        time = 4 * curve.x * viscosity * rms * length / force
        velocity = curve.velocity * rms / time
        # The grey curve (one element in contact) includes the first X with several elements, so that it meets the
        # coloured curve.
        one_element = (~curve.several | np.append(True, ~curve.several[:-1])) & (curve.x >= start)
        for axes, x, y in ((raw, time, velocity), (collapsed, curve.x, curve.velocity)):
            axes.plot(x[one_element], y[one_element], color=style.PALE, zorder=1)
            axes.plot(x[curve.several], y[curve.several], label=case, **look)
        for last in np.flatnonzero(np.isfinite(velocity))[-1:]:
            ends[_combination(case)] = time[last], velocity[last]
    for name, end in ends.items():
        halo = {"path_effects": [withStroke(linewidth=2, foreground="white")]}
        raw.annotate(name, end, (0, 3), textcoords="offset points", ha="center", **halo)
    raw.set(xscale="log", yscale="log", xlabel="time $t$ (s)", ylabel="velocity $v$ (m/s)")
    collapsed.set(xscale="log", yscale="log", xlabel=r"$X = Ft/(4\eta hL)$", ylabel="$vt/h$")
    abscissa_of_paper = collapsed.secondary_xaxis("top", functions=(lambda x: 4 * x, lambda x: x / 4))
    abscissa_of_paper.set_xlabel(r"$Ft/(\eta hL)$, as in the paper")
    collapsed.tick_params(axis="x", which="both", top=False)
    _mark_limits(collapsed, elements_across(ensembles[0]["elements"].item()))
    _mark_windows(collapsed, looks, scaling, conventions)
    realizations = f"each a mean over {style.realizations_text(ensembles)} discs"
    handles = style.hurst_handles(looks, marker="")
    collapsed.legend(handles=handles, loc="upper left", title=realizations, alignment="left")
    _tabulate(below.subplots(), {_combination(case): at for case, at in combinations.items()})
    return figure


def _combination(case):
    """Return the second part of the name <Hurst exponent>_<combination of parameters> of an ensemble."""
    return case.partition("_")[2]


def _tabulate(axes, combinations):
    """Draw a table of parameters, with a column for each combination and a row for each parameter."""
    axes.axis("off")
    cells = [
        _alike([at[quantity] / size for at in combinations.values()]) for quantity, (_, size) in QUANTITIES.items()
    ]
    labels = [label for label, _ in QUANTITIES.values()]
    place = {"bbox": (0.06, 0, 0.94, 1), "cellLoc": "center", "edges": "open"}
    table = axes.table(cells, rowLabels=labels, colLabels=list(combinations), **place)
    table.auto_set_font_size(False)
    table.set_fontsize(style.SMALL)


def _mark_limits(axes, across):
    """Draw the straight lines vt/h = X/κ of regions (a) and (c).

    In region (a), κ is the stiffness of a single element; in region (c), it is the stiffness of a flat punch.
    across : number of elements across the discs
    """
    bottom, top = axes.get_ylim()
    axes.autoscale(False)
    for stiffness, low, start, text, side in (
        (reference.one_element_stiffness(across), bottom, 0.6, "(a) one element in contact", "bottom"),
        (reference.COMPLETE_CONTACT_STIFFNESS, 0.02, 0.1, "(c) flat punch", "top"),
    ):
        axes.plot([stiffness * low, stiffness * top], [low, top], color=style.GREY, linestyle=":", linewidth=0.8)
        y = low * (top / low) ** start
        # Angle of the line in linear coordinates; matplotlib converts this angle to the angle on the page.
        angle = np.degrees(np.arctan(1 / stiffness))
        along = {"rotation": angle, "rotation_mode": "anchor", "transform_rotates_text": True}
        axes.text(stiffness * y, y, text, color=style.GREY, va=side, **along)


def _mark_windows(axes, looks, scaling, conventions):
    """Mark region (b) of each Hurst exponent by a horizontal bar at the bottom of the axes, and name the exponent."""
    text = {"color": style.GREY, "transform": axes.get_xaxis_transform(), "va": "center", "ha": "right"}
    bar = {"linewidth": 2.5, "solid_capstyle": "butt", "transform": axes.get_xaxis_transform()}
    for rank, (hurst, look) in enumerate(reversed(looks.items())):
        for row in fits(scaling, conventions, source="discs", case_group="base", hurst=hurst).itertuples():
            axes.plot([row.x_low, row.x_high], [0.03 + 0.035 * rank] * 2, color=look["color"], **bar)
            axes.text(0.8 * row.x_low, 0.03 + 0.035 * rank, f"{hurst:g}", **text)
    axes.text(0.97, 0.025, "bars: region (b)", color=style.GREY, transform=axes.transAxes, ha="right")


def _alike(values):
    """Return numbers as text, all with a power of ten if the largest number needs one."""
    return [readable(value, power=max(values) >= 1e6) for value in values]
