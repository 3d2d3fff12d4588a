"""Draw Figure 2 of the paper: kinetics of penetration, in dimensionless variables and in SI units."""

import numpy as np

from viscorough import reference
from viscorough_study.ensembles.mean_curve import mean_curve
from viscorough_study.ensembles.pool import elements_across
from viscorough_study.figures import style
from viscorough_study.fits.conventions import fits
from viscorough_study.run.readable import readable

# Units in which the parameters of a combination are written, {parameter: (unit, its value in SI units)}.
UNITS = {"force": ("N", 1.0), "viscosity": ("Pa s", 1.0), "diameter": ("mm", 1e-3), "rms": ("µm", 1e-6)}
THIN = {"linewidth": 0.6}


@style.figure
def plot_kinetics(ensembles, combinations, scaling, conventions, *, fraction_min):
    """Draw vt/h against X (the paper's Figure 2), and the same curves as velocity against time in SI units.

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
    figure, (collapsed, raw) = style.new_subplots(100, 1, 2, width_ratios=(1.6, 1))
    curves = [mean_curve(ds, conventions, fraction_min) for ds in ensembles]
    start = min((curve.x[curve.several][0] for curve in curves if curve.several.any()), default=0) / 10
    for ds, curve in zip(ensembles, curves, strict=True):
        ensemble, color, shown = ds["ensemble"].item(), looks[ds["hurst"].item()]["color"], curve.x >= start
        # The grey curve (one element in contact) includes the first X with several elements, so that it meets the
        # coloured curve.
        one_element = (~curve.several | np.append(True, ~curve.several[:-1])) & shown
        collapsed.plot(curve.x[one_element], curve.velocity[one_element], color=style.PALE, zorder=1)
        collapsed.plot(curve.x[curve.several], curve.velocity[curve.several], label=ensemble, color=color, **THIN)
        force, viscosity, diameter, rms = (combinations[ensemble][name] for name in UNITS)
        time = 4 * curve.x[shown] * viscosity * rms * diameter / force
        raw.plot(time, curve.velocity[shown] * rms / time, label=ensemble, color=style.PALE, **THIN)
    number = style.realizations_text(ensembles)
    collapsed.set_title(f"(a) {len(ensembles)} scaled curves, each a mean over {number} discs")
    collapsed.set(xscale="log", yscale="log", xlabel=r"$X = Ft/(4\eta hL)$", ylabel="$vt/h$")
    abscissa_of_paper = collapsed.secondary_xaxis("top", functions=(lambda x: 4 * x, lambda x: x / 4))
    abscissa_of_paper.set_xlabel(r"$Ft/(\eta hL)$, as in the paper")
    abscissa_of_paper.minorticks_off()
    _mark_limits(collapsed, elements_across(ensembles[0]["elements"].item()))
    _mark_windows(collapsed, looks, scaling, conventions)
    _name_exponents(collapsed, dict(zip((ds["hurst"].item() for ds in ensembles), curves, strict=True)), looks)
    raw.set(xscale="log", yscale="log", xlabel="time $t$ (s)", ylabel="velocity $v$ (m/s)")
    texts = [f"{_combination(ensemble)}: {_text(combinations[ensemble])}" for ensemble in _name_combinations(raw)]
    heading = "(b) the same curves in SI units"
    raw.set_title("\n".join([heading, *texts]), multialignment="left")
    return figure


def _name_exponents(axes, curves, looks):
    """Write the Hurst exponents beside the curves where these lie farthest apart, half of them above, half below.

    curves : {H: mean curve}; looks : {H: line properties}, by ascending H
    """
    velocity = np.array([np.where(curves[hurst].several, curves[hurst].velocity, np.nan) for hurst in looks])
    spread = np.nan_to_num(np.ptp(np.log(velocity), axis=0), nan=-1)
    place, middle = spread.argmax(), len(looks) // 2
    for rank, (hurst, look) in enumerate(looks.items()):
        side, distance = (-1, middle - rank) if rank < middle else (1, rank - middle + 1)
        axes.annotate(
            f"$H={hurst:g}$",
            (curves[hurst].x[place], velocity[rank, place]),
            (16 * side, -side * (8 + 11 * distance)),  # the exponents in the middle are next to the curves
            textcoords="offset points",
            ha="right" if side < 0 else "left",
            va="center",
            color=look["color"],
            arrowprops={"arrowstyle": "-", "linewidth": 0.5, "color": look["color"], "shrinkA": 0, "shrinkB": 0},
            **style.HALO,
        )


def _name_combinations(axes):
    """Name three combinations at the end of their curves: the fastest, the slowest, and one between them.

    Their curves become darker. Return the name of an ensemble of each of these combinations.
    """
    ends = {}
    for line in axes.lines:
        finite = line.get_xydata()[np.isfinite(line.get_ydata())]
        ends |= {_combination(line.get_label()): (line.get_label(), *finite[-1])} if len(finite) else {}
    slow_to_fast = sorted(ends, key=lambda name: ends[name][2])
    geometric_mean = np.sqrt(ends[slow_to_fast[0]][2] * ends[slow_to_fast[-1]][2])
    between = min(ends, key=lambda name: abs(np.log(ends[name][2] / geometric_mean)))
    named = list(dict.fromkeys([slow_to_fast[-1], between, slow_to_fast[0]]))
    for line in axes.lines:
        if _combination(line.get_label()) in named:
            line.set(color=style.GREY, zorder=3)
    for name in named:
        place = {"textcoords": "offset points", "ha": "center", "zorder": 4}
        axes.annotate(name, ends[name][1:], (0, 3), **place, **style.HALO)
    return [ends[name][0] for name in named]


def _combination(ensemble):
    """Return the second part of the name <Hurst exponent>_<combination of parameters> of an ensemble."""
    return ensemble.partition("_")[2]


def _text(combination):
    """Return the force, viscosity, diameter and rms height of a combination as text."""
    return ", ".join(f"{readable(combination[name] / size)} {unit}" for name, (unit, size) in UNITS.items())


def _mark_limits(axes, across):
    """Draw the straight lines vt/h = X/κ of regions (a) and (c).

    In region (a), κ is the stiffness of a single element; in region (c), it is the stiffness of a flat punch.
    across : number of elements across the discs
    """
    bottom, top = axes.get_ylim()
    axes.autoscale(False)
    for stiffness, low, start, text, side, distance in (
        (reference.one_element_stiffness(across), bottom, 0.6, "(a) one element in contact", "bottom", 0.9),
        (reference.COMPLETE_CONTACT_STIFFNESS, 0.02, 0.1, "(c) flat punch", "top", 1.2),
    ):
        axes.plot([stiffness * low, stiffness * top], [low, top], color=style.GREY, linestyle=":", linewidth=0.8)
        y = low * (top / low) ** start
        x = distance * stiffness * y
        # Angle of a parallel line in linear coordinates; matplotlib converts this angle to the angle on the page.
        angle = np.degrees(np.arctan(y / x))
        along = {"rotation": angle, "rotation_mode": "anchor", "transform_rotates_text": True}
        axes.text(x, y, text, color=style.GREY, va=side, **along)


def _mark_windows(axes, looks, scaling, conventions):
    """Mark region (b) of each Hurst exponent by a horizontal bar at the bottom of the axes, and name the exponent."""
    text = {"color": style.GREY, "transform": axes.get_xaxis_transform(), "va": "center", "ha": "right"}
    bar = {"linewidth": 2.5, "solid_capstyle": "butt", "transform": axes.get_xaxis_transform()}
    for rank, (hurst, look) in enumerate(reversed(looks.items())):
        for row in fits(scaling, conventions, source="discs", group="base", hurst=hurst).itertuples():
            axes.plot([row.x_low, row.x_high], [0.03 + 0.035 * rank] * 2, color=look["color"], **bar)
            axes.text(0.8 * row.x_low, 0.03 + 0.035 * rank, f"{hurst:g}", **text)
    axes.text(0.97, 0.025, "bars: region (b)", color=style.GREY, transform=axes.transAxes, ha="right")
