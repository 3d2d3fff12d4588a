"""The reduction of dimensionality against boundary elements, surface by surface.

The line that stands for a surface has its spectrum, C1D = π q C2D (Eq. 13): here that of the very realization, ring by
ring, with phases of its own, since the method says nothing about them.
"""

import numpy as np
import pandas as pd

from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
from viscorough.mdr import line_of_surface, reduce
from viscorough.surfaces import cut_disc, self_affine_square
from viscorough_study.seeds import mdr_comparison_key, realization_seed

COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    "x": ("dimensionless force F/(4GhL) or time Ft/(4ηhL)", "1"),
    "stiffness": ("geometric mean of κ of the discs", "1"),
    "stiffness_ratio": ("geometric mean of κ of the lines over that of the discs", "1"),
    "stiffness_ratio_low": ("lower end of its 95 % interval", "1"),
    "stiffness_ratio_high": ("upper end of its 95 % interval", "1"),
    "stiffness_scatter": ("standard deviation of ln κ of a line over its disc", "1"),
    "area_ratio": ("geometric mean of the contact fraction of the lines over that of the discs", "1"),
    "force_ratio": (
        "geometric mean of X of a line over that of its disc, at equal u/h, where the disc has this X",
        "1",
    ),
    "correlation": ("correlation of ln κ of discs and their lines over the realizations", "1"),
    "realizations": ("realizations", "1"),
}


def compare_reduction(hursts, elements, realizations, x, *, tolerance, seed, progress=iter):
    """Lines against the discs whose spectra they have; a pandas.DataFrame with the columns of `COLUMNS`.

    elements : across a disc of diameter and rms height 1, cut from a square of one period; x : X, shape (abscissae,)
    Abscissae that not every curve reaches are left out.
    """
    rows = []
    for hurst in hursts:
        found, force = [], 4 * x
        for number in progress(range(realizations)):
            key = realization_seed(seed, *mdr_comparison_key(hurst, number))
            of_surface, of_line = key.spawn(2)
            square = self_affine_square(hurst, elements, seed=of_surface)
            square /= np.nanstd(cut_disc(square, elements))
            disc = Indenter(cut_disc(square, elements), 1 / elements)
            line = line_of_surface(square, 1 / elements, of_line)
            curves = indent(disc, tolerance=tolerance, until_force=1.01 * force[-1]), reduce(line)
            found.append(_compared(*curves, force))
        rows += _rows(hurst, x, np.array(found))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _compared(disc, line, force):
    """ln of κ, of contact fraction and of force at the disc's depth: shape (3 quantities, disc and line, abscissae)."""
    depth, stiffness = disc.at_force(force)
    _, of_line = line.at_force(force)
    fractions = [
        np.interp(np.log(force), np.log(curve.force), np.log(curve.contact_fraction)) for curve in (disc, line)
    ]
    at_depth = np.interp(np.log(depth), np.log(line.depth), np.log(line.force))
    return np.log([stiffness / 4, of_line / 4]), fractions, [np.log(force), at_depth]


def _rows(hurst, x, found):
    """Rows of one Hurst exponent; found : what _compared gives, shape (realizations, 3, 2, abscissae)."""
    stiffness, fraction, force = np.moveaxis(found, 1, 0)
    number = len(found)
    ratio = stiffness[:, 1] - stiffness[:, 0]
    error = 1.96 * ratio.std(axis=0, ddof=1) / np.sqrt(number)
    with np.errstate(invalid="ignore", divide="ignore"):
        correlation = [np.corrcoef(stiffness[:, 0, i], stiffness[:, 1, i])[0, 1] for i in range(x.size)]
    values = np.transpose(
        [
            np.exp(stiffness[:, 0].mean(axis=0)),
            np.exp(ratio.mean(axis=0)),
            np.exp(ratio.mean(axis=0) - error),
            np.exp(ratio.mean(axis=0) + error),
            ratio.std(axis=0, ddof=1),
            np.exp((fraction[:, 1] - fraction[:, 0]).mean(axis=0)),
            np.exp((force[:, 1] - force[:, 0]).mean(axis=0)),
            correlation,
        ]
    )
    return [(hurst, at, *each, number) for at, each in zip(x, values, strict=True) if np.isfinite(each[:-1]).all()]
