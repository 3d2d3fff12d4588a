"""Ensembles of given curves, and the evidence and conventions by which claims are judged."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
import yaml

from viscorough import LoadingCurve, reference
from viscorough_study.comparisons.direct_integration import compare_direct
from viscorough_study.ensembles.averages import DIMENSIONS, abscissa, on_abscissae, with_averages
from viscorough_study.ensembles.pool import REALIZATION_COORDINATES, VARIABLES
from viscorough_study.fits.conventions import READINGS
from viscorough_study.fits.fit_table import scaling_table
from viscorough_study.fits.intervals import UNDEFINED, three_columns
from viscorough_study.fits.zeta_laws import zeta_laws_of_pool
from viscorough_study.run.names import SHOWN
from viscorough_study.verdicts.evidence import Evidence

ROOT = Path(__file__).resolve().parents[2]
NUMBERS = yaml.safe_load((ROOT / "resources/paper/numbers.yaml").read_text(encoding="utf-8"))
LIMITS = {"elements_min": 10, "stiffness_max": 0.2, "slope_max": 0.8, "slope_half_width": 0.25}
LIMITS |= {"fraction_min": 0.95, "decades_min": 0.5}
BOOTSTRAP = {"resamples": 50, "seed": 1}
FINE = [  # β on fine grids: its limit is known at H = 0.4, and open at H = 0.1
    {"hurst": hurst, "x_low": 1e-3, "across": 4097, "expected": hurst / (1 + hurst), "finding": finding}
    | three_columns("beta", (0.3, 0.28, 0.32))
    | three_columns("limit", limit)
    for hurst, finding, limit in ((0.1, "open", UNDEFINED), (0.4, "within", (0.29, 0.28, 0.3)))
]
X = abscissa(1e-7, 30.0, 20)
HURST = (0.4, 0.6, 0.9)
ACROSS, ELEMENTS = 257, 51433


def ensemble(hurst, name, zeta, *, bent=0.0, scatter=0.02, seed=0, square=1.0):
    """Make discs with κ = ζ X^α from one element in contact to complete contact.

    square : factor on ζ with h of the square, which is the h of reading B; bent : added to α
    scatter : standard deviation of ln ζ over 20 realizations
    """
    random = np.random.default_rng([seed, round(hurst * 1e6)])
    alpha = reference.exponent_alpha(hurst) + bent
    one_element = reference.one_element_stiffness(ACROSS)
    factor = np.exp(scatter * random.standard_normal((20, 1)))
    stiffness = np.clip([scale * zeta * factor * X**alpha for scale in (1.0, square)], one_element, 1.0)
    count = np.where(stiffness > one_element, np.maximum(ELEMENTS * stiffness**2, 2.0), 1.0)
    return ensemble_of(
        X, stiffness, count, conventions=("disc", "square"), hurst=hurst, ensemble=name, elements=ELEMENTS
    )


def pool_of(members, group="base"):
    """Join ensembles to a pool without averages."""
    parts = []
    for member in members:
        coords = {name: member[name].item() for name in REALIZATION_COORDINATES if name != "group"} | {"group": group}
        part = member[list(VARIABLES)].drop_vars([name for name in coords if name != "group"])
        size = member.sizes["realization"]
        parts.append(part.assign_coords({name: ("realization", [value] * size) for name, value in coords.items()}))
    return xr.concat(parts, "realization")


def evidence(zeta=reference.zeta_elastic, **options):
    """Make evidence of four combinations and three Hurst exponents, with lines that equal the first combination.

    The discs of both readings are the same, but for the rms height.

    zeta : function of H; options : as in `ensemble`. The caller may change the returned copy; the same evidence is made
        once.
    """
    made = _evidence(zeta, **options)
    return replace(made, discs=made.discs.copy(deep=True), tables={name: t.copy() for name, t in made.tables.items()})


@cache
def _evidence(zeta, **options):
    members = [ensemble(hurst, f"c{i}", zeta(hurst), seed=i, **options) for hurst in HURST for i in range(4)]
    discs, lines = pool_of(members), pool_of(4 * members[::4])  # at least as many as the paper averages
    lines = lines.sel(rms_convention=["disc"]).assign_coords(rms_convention=["line"])
    discs = xr.concat([discs, pool_of(members, READINGS["B"]["group"])], "realization")
    fit = {"stiffness_range": [0.03, 0.3], **LIMITS}
    slope = pd.DataFrame({"hurst": HURST} | three_columns("half_spread", (0.02, 0.01, 0.03)))
    slope = slope.assign(realizations=80, line_residual=0.005)
    return evidence_of(
        discs,
        scaling=scaling_table(discs, lines, **BOOTSTRAP, **fit),
        zeta_laws=zeta_laws_of_pool(discs, average="geometric", hurst_mins=(0.0, 0.6), fit=fit, **BOOTSTRAP),
        local_slope=pd.concat([slope.assign(group=own["group"]) for own in READINGS.values()]),
        direct=compare_direct(hursts=HURST, elements=17, impulses=25, seed=1),
        fine_exponents=pd.DataFrame(FINE),
        **mdr_tables(),
    )


def evidence_of(discs, **tables):
    """Make evidence of a pool of discs and these tables."""
    rules = {"limits": LIMITS, **BOOTSTRAP}
    return Evidence(discs=discs, tables=tables, numbers=NUMBERS, conventions=SHOWN, across=ACROSS, **rules)


def evidence_of_curves(stiffness, count):
    """Make evidence of discs of one H with these κ and elements in contact, shape (realizations, abscissae)."""
    return evidence_of(pool_of([ensemble_of(X, stiffness, count, elements=ELEMENTS)]))


def evidence_with_factors(scatter):
    """Make evidence of 80 discs of each Hurst exponent, with the same random factors on κ at every H.

    scatter : standard deviation of the factors' logarithms, which have the mean 0

    If Hurst exponents shared the draws of a bootstrap, all their means would move by the same factor.
    """
    normal = np.random.default_rng(9).standard_normal(80)
    factors = np.exp(scatter * (normal - normal.mean()) / normal.std(ddof=1)).reshape(4, 20, 1)
    members = []
    for hurst in HURST:
        same = ensemble(hurst, "c", reference.zeta_elastic(hurst), scatter=0.0)
        members += [same.assign(stiffness=same["stiffness"] * factor) for factor in factors]
    return evidence_of(pool_of(members))


def mdr_tables(drift=1.0, ratio=1.0):
    """Make tables of lines against discs with narrow intervals, in which λ drifts by a factor.

    ratio : ratio of contact fractions and of gaps
    """

    def interval(name, value, half):
        return three_columns(name, (value, value - half, value + half))

    summary = interval("drift", drift, 0.01) | interval("error_trend", np.log(drift) / 4, 0.005)
    compared = interval("area_ratio", ratio, 0.01) | {"realizations": 1000}
    x = np.geomspace(1e-4, 1, 9)
    gap = interval("gap_ratio", np.where(np.arange(9) % 2, np.nan, ratio), 0.01)
    every = pd.DataFrame({"hurst": HURST})
    exponents = every.assign(window="own region", realizations=1000, **interval("difference", 0.0, 0.005))
    return {
        "mdr_exponents": exponents,
        "mdr_summary": every.assign(**summary, realizations=1000),
        "reduction": every.merge(pd.DataFrame({"x": x} | compared | gap), how="cross"),
    }


def three_regions(x):
    """Return κ at X of a curve with regions (a), one element of a million, (b), 1.2 X^0.6, and (c), 1."""
    return np.clip(1.2 * x**0.6, 1e-6, 1)


def ensemble_of(x, stiffness, count=None, *, conventions=("disc",), **coords):
    """Make an ensemble dataset of these curves.

    x : X, shape (abscissae,); stiffness : κ, shape (conventions, realizations, abscissae), the first axes optional

    count : elements in contact, by default κ N of N elements; conventions : names of the rms heights; coords : hurst,
        ensemble, elements
    """
    stiffness = np.array(stiffness, ndmin=3)
    coords = {"hurst": 0.7, "ensemble": "c", "elements": 10**6} | coords
    count = coords["elements"] * stiffness if count is None else np.broadcast_to(count, stiffness.shape)
    curves = {"stiffness": (DIMENSIONS, stiffness), "contact_count": (DIMENSIONS, count)}
    coords |= {"x": ("abscissa", x), "rms_convention": list(conventions), "until_x": np.inf}
    return with_averages(xr.Dataset(curves, coords))


def line_curve(gaps, length=1.0, levels=None):
    """Return the exact curve of N springs: every event is a level, and one level follows.

    F/G = 4 Δx Σ(u−g)₊, k/G = 4 Δx number.
    """
    gaps = np.sort(np.asarray(gaps, dtype=float))
    spacing = length / gaps.size
    depth = np.append(gaps[1:], 3 * gaps[-1])
    touching = np.arange(1, gaps.size + 1)
    force = 4 * spacing * np.maximum(depth[:, None] - gaps, 0).sum(axis=1)
    columns = (depth, force, 4 * spacing * touching, touching)
    columns = [column[:levels] for column in columns]
    return LoadingCurve(*columns, gaps.size, "by hand", 1e-12, 0, 0 * columns[0])


def aggregate(curves, rms, diameter, x, *, hurst, ensemble):
    """Make an ensemble dataset of the loading curves of one ensemble; arguments as in on_abscissae."""
    coords = {"hurst": hurst, "ensemble": ensemble, "elements": curves[0].elements}
    return ensemble_of(np.asarray(x, dtype=float), *on_abscissae(curves, rms, diameter, x), conventions=rms, **coords)
