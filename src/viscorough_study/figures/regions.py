"""Draw the regions of the curves: the local slope in region (b), and the contact where region (c) begins."""

import numpy as np

from viscorough.reference import exponent_beta
from viscorough_study.figures import style
from viscorough_study.fits.conventions import CONTROL
from viscorough_study.fits.power_law import in_window, inner_slopes
from viscorough_study.verdicts.curves import SLOPES_OF_LINE, start_of_line

DASHED = {"linestyle": "--", "linewidth": 0.8}
DOTTED = {"linestyle": ":", "linewidth": 1.6}


@style.figure
def plot_regions(discs, controls, local_slope, *, fraction_min, half_width):
    """Draw the local slope d ln(vt/h)/d ln X (a) and the share of the elements in contact (b), over X.

    discs : ensemble datasets of reading A, one for each Hurst exponent
    controls : ensemble datasets of discs without long waves
    local_slope : table of fits.local_slope, with the ends of region (b) of the discs and of the controls
    fraction_min : a mean is drawn if at least this fraction of the realizations has a value
    half_width : a local slope is fitted over ± this many decades of X

    Thick lines: region (b). Dashed: H/(1 + H). Dotted: the control, in its region (b). Markers in (b): the X from which
    on the slope is 1 within `SLOPES_OF_LINE`, filled for the larger deviation.
    """
    discs, controls = ([ensemble.sel(rms_convention="disc") for ensemble in each] for each in (discs, controls))
    looks = style.hurst_looks(ensemble["hurst"].item() for ensemble in discs)
    figure, (slope, contact) = style.new_subplots(75, 1, 2)
    for ensemble in discs:
        hurst = ensemble["hurst"].item()
        look = {"color": looks[hurst]["color"]}
        x, slopes = _slopes(ensemble, fraction_min, half_width)
        slope.plot(x, slopes, linewidth=0.8, **look)
        for row in local_slope.query("group == 'base' and hurst == @hurst").dropna(subset="x_low").itertuples():
            inside = in_window(x, (row.x_low, row.x_high))
            slope.plot(x[inside], slopes[inside], linewidth=2.2, **look)
            slope.plot([row.x_low, row.x_high], [exponent_beta(hurst)] * 2, **DASHED, **look)
        _draw_contact(contact, ensemble, fraction_min, looks[hurst])
    for ensemble in controls:
        hurst = ensemble["hurst"].item()
        x, slopes = _slopes(ensemble, fraction_min, half_width)
        rows = local_slope[(local_slope["group"] == CONTROL) & (local_slope["hurst"] == hurst)]
        for row in rows.dropna(subset="x_low").itertuples():
            inside = in_window(x, (row.x_low, row.x_high))
            slope.plot(x[inside], slopes[inside], color=looks[hurst]["color"], **DOTTED)
    slope.set(xscale="log", xlim=(1e-6, None), ylim=(0, 1.1), title="(a) local slope of $vt/h$ over $X$", xlabel="$X$")
    contact.set(
        xscale="log", xlim=(1e-2, None), ylim=(0, 1), title="(b) share of the elements in contact", xlabel="$X$"
    )
    handles = [
        *style.hurst_handles(looks, linestyle="-", marker=""),
        style.handle("region (b)", color=style.GREY, linewidth=2.2),
        style.handle("$H/(1+H)$", color=style.GREY, **DASHED),
        style.handle("no long waves", color=style.GREY, **DOTTED),
        *(
            style.handle(f"slope 1 within {deviation:g}", color=style.GREY, linestyle="", marker="o", **face)
            for deviation, face in zip(SLOPES_OF_LINE, FACES, strict=True)
        ),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=5)
    return figure


FACES = ({}, {"markerfacecolor": "white"})


def _slopes(ensemble, fraction_min, half_width):
    """Return X and the local slope of the geometric mean of vt/h, where enough realizations have a value."""
    defined = ensemble["fraction_defined"].values >= fraction_min
    log_x, log_y = np.log(ensemble["x"].values[defined]), np.log(ensemble["velocity_geometric"].values[defined])
    inner, (slopes,) = inner_slopes(log_x, log_y[None], half_width * np.log(10))
    return np.exp(inner), slopes


def _draw_contact(axes, ensemble, fraction_min, look):
    defined = ensemble["fraction_defined"].values >= fraction_min
    x, share = ensemble["x"].values, ensemble["contact_count"].mean("realization").values / ensemble["elements"].item()
    axes.plot(x[defined], share[defined], color=look["color"])
    for deviation, face in zip(SLOPES_OF_LINE, FACES, strict=True):
        if (start := start_of_line(ensemble, deviation)) is not None:
            axes.plot(x[start], share[start], color=look["color"], marker=look["marker"], **face)
