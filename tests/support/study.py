"""Ensembles of given curves, and the evidence and conventions by which claims are judged."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from viscorough import LoadingCurve, reference
from viscorough_study.comparisons.direct_integration import compare_direct
from viscorough_study.comparisons.mdr_equivalence import WINDOWS
from viscorough_study.ensembles.averages import DIMENSIONS, abscissa, on_abscissae, with_averages
from viscorough_study.ensembles.pool import REALIZATION_COORDINATES, VARIABLES
from viscorough_study.fits.fit_table import scaling_table
from viscorough_study.fits.intervals import three_columns
from viscorough_study.fits.zeta_laws import zeta_laws
from viscorough_study.run.paper_data import read_paper
from viscorough_study.verdicts.evidence import Evidence

ROOT = Path(__file__).resolve().parents[2]
CLAIMS, NUMBERS = (read_paper(ROOT / "resources/paper", name) for name in ("claims", "numbers"))
SHOWN = {"average": "geometric", "rms_convention": "disc", "window_rule": "default", "gamma": "without"}
LIMITS = {"elements_min": 10, "stiffness_max": 0.2, "slope_max": 0.8, "slope_half_width": 0.25}
LIMITS |= {"fraction_min": 0.95, "decades_min": 0.5}
RULES = {"decades_min": 2.0, "end_decades": 0.25}
GRIDS = [  # κ at u/h = 1 of three Hurst exponents, on two grids with enough elements in contact; vt/h of one of them
    {"hurst": hurst, "quantity": quantity, "across": across, "value": value, "compared": int(across > 33)}
    | three_columns("factor", factor)
    for hurst, quantity, factor in (
        (0.4, "κ at u/h = 1", (0.7, 0.6, 0.8)),
        (0.6, "κ at u/h = 1", (0.9, 0.8, 1.0)),
        (0.9, "κ at u/h = 1", (1.01, 0.98, 1.04)),
        (0.9, "vt/h at X = 1", (0.5, 0.4, 0.6)),
    )
    for across, value in ((33, 0.4), (65, 0.3), (129, 0.2))
]
METHODS = [  # 1 ms for a step, 1 ns for a point
    ("explicit, logarithmic steps", 0.8, 257, 16, 1.0, 0.1, 16),
    ("explicit, logarithmic steps", 0.8, 257, 256, 0.256, 0.005, 256),
    ("path, automatic levels", 0.8, 257, 0.1, 0.02, 0.03, 15),
    ("path, automatic levels", 0.8, 257, 0.01, 0.04, 0.005, 58),
    ("path, automatic levels", 0.4, 257, 0.01, 0.05, 0.004, 51),
    ("path, automatic levels", 0.4, 257, 0.001, 0.08, 0.0005, 413),
    ("path, automatic levels", 0.4, 65, 0.001, 0.08, 0.0005, 7),
    ("MDR", 0.8, 257, 1e6, 1e-3, 0.2, 1e6),
    ("MDR", np.nan, 257, 1e7, 1.0, 0.2, 1e7),
    ("MDR", 0.8, 65, 1e7, 1.0, 0.2, 1e7),
]
BOOTSTRAP = {"resamples": 50, "seed": 1}
X = abscissa(1e-7, 30.0, 20)
HURST = (0.4, 0.6, 0.9)
ACROSS, ELEMENTS = 257, 51433


def ensemble(hurst, case, zeta, *, bent=0.0, scatter=0.02, seed=0, square=1.0):
    """Make discs with κ = ζ X^α from one element in contact to complete contact.

    square : factor on ζ in the convention with h of the square; bent : added to α; scatter : standard deviation of ln ζ
        over 20 realizations
    """
    random = np.random.default_rng([seed, round(hurst * 1e6)])
    alpha = reference.exponent_alpha(hurst) + bent
    one_element = reference.one_element_stiffness(ACROSS)
    factor = np.exp(scatter * random.standard_normal((20, 1)))
    stiffness = np.clip([scale * zeta * factor * X**alpha for scale in (1.0, square)], one_element, 1.0)
    count = np.where(stiffness > one_element, np.maximum(ELEMENTS * stiffness**2, 2.0), 1.0)
    return ensemble_of(X, stiffness, count, conventions=("disc", "square"), hurst=hurst, case=case, elements=ELEMENTS)


def pool_of(members, group="base"):
    """Join ensembles, each of one case, to a pool without averages."""
    parts = []
    for member in members:
        coords = {name: member[name].item() for name in REALIZATION_COORDINATES if name != "group"} | {"group": group}
        part = member[list(VARIABLES)].drop_vars([name for name in coords if name != "group"])
        size = member.sizes["realization"]
        parts.append(part.assign_coords({name: ("realization", [value] * size) for name, value in coords.items()}))
    return xr.concat(parts, "realization")


def evidence(zeta=reference.zeta_elastic, **options):
    """Make evidence of four combinations and three Hurst exponents, with lines that equal the first combination.

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
    scaling = scaling_table(discs, lines, **BOOTSTRAP, stiffness_range=[0.03, 0.3], **LIMITS)
    plateaus = pd.DataFrame({"hurst": HURST} | three_columns("decades", (2.4, 2.2, 2.6)))
    plateaus = plateaus.assign(**three_columns("half_spread", (0.02, 0.01, 0.03)), region_decades=1.5)
    validation = pd.DataFrame({"case": "sphere_reduction", "quantity": "depth", "elements": (65, 129)})
    evidence = evidence_of(
        discs,
        scaling=scaling,
        validation=validation.assign(error=1 / validation["elements"] ** 2),
        direct=compare_direct(hursts=HURST, elements=17, impulses=25, seed=1),
        methods=pd.DataFrame(METHODS, columns=["method", "hurst", "elements", "value", "wall_s", "error", "steps"]),
        grid_dependence=pd.DataFrame(GRIDS),
        sizes=scaling.query("source == 'discs'").assign(case_group="sizes", elements=round(0.778 * ACROSS**2)),
        plateaus=plateaus.assign(case_group="base", realizations=80, power_law_fails=0.0),
        **mdr_tables(),
    )
    laws = zeta_laws(evidence.pooled, evidence.regions, (0.0, 0.6), average="geometric", **BOOTSTRAP)
    return replace(evidence, tables=evidence.tables | {"zeta_laws": laws})  # the evidence has not pooled the discs yet


def evidence_of(discs, **tables):
    """Make evidence of a pool of discs and these tables."""
    rules = {"limits": LIMITS, "rules": RULES, "surfaces": ["base"], **BOOTSTRAP}
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

    ratio : ratio of contact fractions and of gaps; also the factor between single stiffnesses
    """

    def interval(name, value, half):
        return three_columns(name, (value, value - half, value + half))

    summary = interval("drift", drift, 0.01) | interval("error_trend", np.log(drift) / 4, 0.005)
    summary |= interval("error_whole", np.abs(np.log(drift)), 0.005) | {"realizations": 1000}
    difference = [interval("difference", np.log(drift) / 10, 0.002) | {"window": name} for name in WINDOWS]
    compared = interval("area_ratio", ratio, 0.01) | {"realizations": 1000, "stiffness_scatter": np.log(ratio)}
    x = np.geomspace(1e-4, 1, 9)
    gap = interval("gap_ratio", np.where(np.arange(9) % 2, np.nan, ratio), 0.01)
    every = pd.DataFrame({"hurst": HURST})
    return {
        "histories": every.assign(deviation=-2e-5, deviation_coarse=8e-5),
        "mdr_summary": every.assign(**summary),
        "mdr_exponents": every.merge(pd.DataFrame(difference).assign(realizations=1000), how="cross"),
        "reduction": every.merge(pd.DataFrame({"x": x} | compared | gap), how="cross"),
    }


def three_regions(x):
    """Return κ at X of a curve with regions (a), one element of a million, (b), 1.2 X^0.6, and (c), 1."""
    return np.clip(1.2 * x**0.6, 1e-6, 1)


def ensemble_of(x, stiffness, count=None, *, conventions=("disc",), **coords):
    """Make an ensemble dataset of these curves.

    x : X, shape (abscissae,); stiffness : κ, shape (conventions, realizations, abscissae), the first axes optional

    count : elements in contact, by default κ N of N elements; conventions : names of the rms heights; coords : hurst,
        case, elements
    """
    stiffness = np.array(stiffness, ndmin=3)
    coords = {"hurst": 0.7, "case": "c", "elements": 10**6} | coords
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


def aggregate(curves, rms, diameter, x, *, hurst, case):
    """Make an ensemble dataset of the loading curves of one case; arguments as in on_abscissae."""
    coords = {"hurst": hurst, "case": case, "elements": curves[0].elements}
    return ensemble_of(np.asarray(x, dtype=float), *on_abscissae(curves, rms, diameter, x), conventions=rms, **coords)
