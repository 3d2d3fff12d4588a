"""Figure 2 of the paper: kinetics of penetration, in SI units and in dimensionless variables."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from viscorough import reference
from viscorough_study.conventions import LENGTH, fits
from viscorough_study.figures.mean_curve import mean_curve
from viscorough_study.figures.style import GREY, MM, PALE, STYLE, WIDE, hurst_handles, hurst_looks, logarithmic_ticks


@rc_context(STYLE)
def plot_kinetics(ensembles, combinations, scaling, conventions, *, fraction_min):
    """Velocity over time in SI units, and vt/h over Ft/(hηL) computed from them (Eq. 2).

    ensembles : ensemble datasets, one for each case
    combinations : {case: force [N], viscosity [Pa s], diameter [m], rms [m]}
    scaling : scaling table, which has region (b); conventions : {column of it: value}
    fraction_min : smallest share of the realizations defined, for a mean to be drawn

    Grey where one element is in contact, region (a), of which one decade is drawn; bars at the bottom are the windows
    of region (b). The rms height is that of the combination, which is exact if h is measured where it was prescribed.
    """
    looks = hurst_looks(ds["hurst"].item() for ds in ensembles)
    figure = Figure(figsize=(WIDE, 95 * MM))
    raw, collapsed = figure.subplots(1, 2, width_ratios=(1, 1.3))
    curves = [mean_curve(ds, conventions, fraction_min) for ds in ensembles]
    length_over_diameter = LENGTH[conventions["diameter_convention"]]
    start = min((curve.x[curve.several][0] for curve in curves if curve.several.any()), default=0) / 10
    ends = {}
    for ds, curve in zip(ensembles, curves, strict=True):
        case, look = ds["case"].item(), looks[ds["hurst"].item()] | {"marker": "", "linewidth": 0.8}
        time, velocity, dimensionless = _in_units(curve, combinations[case], length_over_diameter)
        single = (~curve.several | np.append(True, ~curve.several[:-1])) & (curve.x >= start)  # and the point after it
        for axes, (x, y) in ((raw, (time, velocity)), (collapsed, dimensionless)):
            axes.plot(x[single], y[single], color=PALE, zorder=1)
            axes.plot(x[curve.several], y[curve.several], label=case, **look)
        for last in np.flatnonzero(np.isfinite(velocity))[-1:]:
            ends[case.partition("_")[2]] = time[last], velocity[last]
    raw.set(xscale="log", yscale="log", xlabel="time $t$ (s)", ylabel="velocity $v$ (m/s)")
    raw.margins(0.08)
    for name, end in ends.items():
        halo = [withStroke(linewidth=2, foreground="white")]
        raw.annotate(name, end, (0, -3), textcoords="offset points", ha="center", va="top", path_effects=halo)
    collapsed.set(xscale="log", yscale="log", xlabel=r"$Ft/(h\eta L)$", ylabel="$vt/h$")
    _mark_limits(collapsed, _elements_across(ensembles[0]["elements"].item()), length_over_diameter)
    _mark_windows(collapsed, looks, scaling, conventions)
    collapsed.legend(handles=hurst_handles(looks, marker=""), loc="upper left")
    logarithmic_ticks(raw, collapsed)
    return figure


def _in_units(curve, combination, length_over_diameter):
    """Time [s], velocity [m/s], and (Ft/(hηL), vt/h) computed from these."""
    force, viscosity, diameter, rms = (combination[name] for name in ("force", "viscosity", "diameter", "rms"))
    length = diameter * length_over_diameter
    time = 4 * curve.x * viscosity * rms * length / force
    velocity = curve.velocity * rms / time
    return time, velocity, (force * time / (rms * viscosity * length), velocity * time / rms)


def _mark_limits(axes, elements_across, length_over_diameter):
    """Limits (a) and (c), vt/h = X/κ of one element and of complete contact, over Ft/(hηL) = 4X."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    for stiffness, low, start, text, side in (
        (reference.one_element_stiffness(elements_across), bottom, 0.6, "(a) one element in contact", "bottom"),
        (reference.COMPLETE_CONTACT_STIFFNESS, 0.02, 0.1, "(c) complete contact", "top"),
    ):
        x_of_y = 4 * stiffness / length_over_diameter
        axes.plot([x_of_y * low, x_of_y * top], [low, top], color=GREY, linestyle=":", linewidth=0.8)
        y = low * (top / low) ** start
        _text_along(axes, x_of_y * y, y, text, color=GREY, va=side)
    axes.set(xlim=(left, right), ylim=(bottom, top))


def _mark_windows(axes, looks, scaling, conventions):
    """Windows of region (b) as bars at the bottom, over Ft/(hηL) = 4X."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    bar = {"linewidth": 2.5, "solid_capstyle": "butt", "transform": axes.get_xaxis_transform()}
    for rank, (hurst, look) in enumerate(reversed(looks.items())):
        for row in fits(scaling, conventions, source="discs", case_group="base", hurst=hurst).itertuples():
            axes.plot([4 * row.x_low, 4 * row.x_high], [0.03 + 0.025 * rank] * 2, color=look["color"], **bar)
    axes.text(0.97, 0.025, "bars: region (b)", color=GREY, transform=axes.transAxes, ha="right")
    axes.set(xlim=(left, right), ylim=(bottom, top))


def _elements_across(elements):
    """Elements across a disc that has this many elements in the circle through the outermost centres."""
    return round(1 + 2 * np.sqrt(elements / np.pi))


def _text_along(axes, x, y, text, **look):
    """Text from (x, y) on, in the direction of a line of slope 1 in double logarithmic axes."""
    angle = np.degrees(np.arctan2(y, x))  # of the line through the origin: y ∝ x has slope 1 in the logarithms
    axes.text(x, y, text, rotation=angle, rotation_mode="anchor", transform_rotates_text=True, **look)
