"""Ensembles and fits of small discs and lines, shared by the tests of the figures."""

import warnings

import pandas as pd
import pytest

from support import figures as tables
from support.figures import COMBINATIONS, ELEMENTS, HURST, X, case_of
from support.study import LIMITS, SHOWN, aggregate, pool_of
from support.workflow import FIGURES
from viscorough.contact.loading_path import indent
from viscorough.mdr import reduce
from viscorough.surfaces import self_affine_disc, self_affine_line
from viscorough_study.ensembles.pool import ensembles
from viscorough_study.fits.fit_table import COLUMNS, fit_rows

SCALING = LIMITS | {"elements_min": 3, "stiffness_range": (0.03, 0.3)}


@pytest.fixture(scope="session")
def curves():
    """{(H, combination): two loading curves}; the surfaces of a Hurst exponent are the same but for their units."""
    result = {}
    for hurst in HURST:
        for name, at in COMBINATIONS.items():
            lengths = {"rms": at["rms"], "diameter": at["diameter"]}
            discs = [self_affine_disc(hurst, ELEMENTS, **lengths, seed=seed) for seed in (1, 2)]
            limit = 4 * at["rms"] * at["diameter"] * 31
            result[hurst, name] = [indent(disc, until_force=limit) for disc in discs]
    return result


@pytest.fixture(scope="session")
def discs(curves):
    """Ensemble of every case, all of two realizations."""
    members = []
    for (hurst, name), pair in curves.items():
        rms, diameter = COMBINATIONS[name]["rms"], COMBINATIONS[name]["diameter"]
        case = case_of(hurst, name)
        members.append(aggregate(pair, {"disc": rms, "square": 1.1 * rms}, diameter, X, hurst=hurst, case=case))
    return members


@pytest.fixture(scope="session")
def pooled(discs):
    return list(ensembles(pool_of(discs), "hurst").values())


@pytest.fixture(scope="session")
def lines():
    result = []
    for hurst in HURST:
        reduced = [reduce(self_affine_line(hurst, 1024, seed=seed)) for seed in (1, 2)]
        result.append(aggregate(reduced, {"line": 1.0}, 1.0, X, hurst=hurst, case="lines"))
    return result


@pytest.fixture(scope="session")
def scaling(pooled, lines):
    rows = []
    for ensemble, line in zip(pooled, lines, strict=True):
        options = {"resamples": 20, "seed": 1, **SCALING}
        rows += fit_rows(ensemble, source="discs", case_group="base", lines=line, **options)
        rows += fit_rows(ensemble, source="discs", case_group="roll_off", **options)
        rows += fit_rows(line, source="lines", case_group="base", **options)
    return pd.DataFrame(rows, columns=list(COLUMNS))


@pytest.fixture(scope="session")
def combinations():
    return {case_of(hurst, name): at for hurst in HURST for name, at in COMBINATIONS.items()}


@pytest.fixture(scope="session")
def drawn(discs, pooled, lines, scaling, combinations):
    """{file of the report: its figure}, from small tables and without a warning."""
    heights, measured = self_affine_disc(0.5, 9, seed=1).heights, tables.fits_of_a_group(pooled, scaling)
    arguments = tables.FROM_TABLES | {
        "fig1_surfaces": ([(h, heights, 1 / 9) for h in (0.1, 0.5, 0.9)],),
        "fig2_kinetics": (discs, combinations, scaling, SHOWN),
        "fig3_master_curve": (pooled, lines, scaling, SHOWN),
        "fig4_exponent": (scaling, SHOWN, (0.4, 1.0)),
        "conventions": (scaling, SHOWN),
        "measured": ({"polished": pooled[0]}, pooled, measured, tables.measured_kinetics(), SHOWN),
    }
    params = {name: figure.get("params", []) for name, figure in FIGURES.items()}
    shares = {name: {"fraction_min": 0.95} for name in params if "fraction_min" in params[name]}
    with warnings.catch_warnings(action="error"):
        return {
            name: tables.plot(tables.MODULES[name], *given, **shares.get(name, {})) for name, given in arguments.items()
        }
