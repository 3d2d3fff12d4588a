"""Write the interactive Figure 2 of the page, and collect its curves.

The page embeds uPlot, a library for charts (workflow/page/uplot), and workflow/page/chart.js, which uses it.
"""

import json

import numpy as np
from markupsafe import Markup
from matplotlib.colors import to_hex

from viscorough.io.datasets import read_dataset
from viscorough.reference import one_element_stiffness
from viscorough_study.ensembles import pool
from viscorough_study.ensembles.mean_curve import mean_curve
from viscorough_study.run.hurst_colors import hurst_color

DIGITS = 4  # significant digits of the numbers in the page


def chart(folder, discs, combinations, conventions, fraction_min):
    """Return the chart as HTML: the style of uPlot, the data of the curves, uPlot, and the script that draws them.

    folder : folder of the templates of the page
    discs, combinations, conventions, fraction_min : see `chart_data`
    """
    names = ("uplot/uPlot.min.css", "uplot/uPlot.iife.min.js", "chart.js")
    style, library, script = ((folder / name).read_text("utf-8") for name in names)
    data = json.dumps(chart_data(discs, combinations, conventions, fraction_min), separators=(",", ":"))
    parts = f'<style>\n{style}</style>\n<script id="curves" type="application/json">{data}</script>\n'
    return Markup(f"{parts}<script>\n{library}</script>\n<script>\n{script}</script>\n")


def chart_data(discs, combinations, conventions, fraction_min):
    """Return the mean curves of Figure 2, {"x": abscissae X, "curves": list of dicts, "limits": list of dicts}.

    A curve is a dict with
        hurst, combination : Hurst exponent, and name of the combination of force, viscosity, diameter and rms height
        force, viscosity, diameter, rms : the combination in SI units
        color : its colour as a text like #31688e
        velocity : vt/h at the abscissae, None at abscissae without a mean
        elements : median number of elements in contact at the abscissae

    A limit is a straight line, with its label and the ratio of vt/h and X: one element in contact, or a flat punch.

    As in Figure 2, the curves begin a decade before the first X with several elements in contact.

    discs : NetCDF file with the loading curves of all discs (ensembles.pool)
    combinations : {name of the ensemble: force [N], viscosity [Pa s], diameter [m], rms [m]}
    conventions, fraction_min : see ensembles.mean_curve
    """
    ensembles = list(pool.ensembles(pool.select(read_dataset(discs), group="base"), "ensemble").values())
    means = [mean_curve(ensemble, conventions, fraction_min) for ensemble in ensembles]
    start = min((mean.x[mean.several][0] for mean in means if mean.several.any()), default=0.0) / 10
    curves = []
    for ensemble, mean in zip(ensembles, means, strict=True):
        shown, hurst, name = mean.x >= start, ensemble["hurst"].item(), ensemble["ensemble"].item()
        curve = {"hurst": hurst, "combination": name.partition("_")[2]} | combinations[name]
        curve["color"] = to_hex(hurst_color(hurst))
        curve["velocity"] = _rounded(mean.velocity[shown])
        curve["elements"] = _rounded(np.where(np.isfinite(mean.velocity), mean.elements, np.nan)[shown])
        curves.append(curve)
    across = pool.elements_across(ensembles[0]["elements"].item())
    limits = [
        {"label": "one element in contact", "ratio": 1 / one_element_stiffness(across)},
        {"label": "flat punch", "ratio": 1.0},
    ]
    return {"x": _rounded(means[0].x[means[0].x >= start]), "curves": curves, "limits": limits}


def _rounded(values):
    """Return the values as a list of numbers with `DIGITS` significant digits; None for nan."""
    return [float(f"{value:.{DIGITS}g}") if np.isfinite(value) else None for value in values]
