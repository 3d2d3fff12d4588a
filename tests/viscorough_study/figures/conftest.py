"""Ensembles of small discs and lines, and all figures drawn, shared by the tests of the figures."""

import warnings

import pytest

from support import figures as tables
from support.figures import COMBINATIONS, ELEMENTS, HURST, X, case_of, published
from support.study import SHOWN, aggregate, pool_of
from support.workflow import FIGURES, RULES
from viscorough.contact.loading_path import indent
from viscorough.mdr import reduce
from viscorough.surfaces.self_affine import self_affine_disc, self_affine_line
from viscorough_study.ensembles.pool import ensembles


@pytest.fixture(scope="session")
def curves():
    """Return {(H, combination): two curves}; the surfaces of a Hurst exponent differ only in their units."""
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
    """Return an ensemble for every case, each of two realizations."""
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
def scaling():
    return published("scaling")


@pytest.fixture(scope="session")
def drawn(discs, pooled, lines, scaling):
    """Return {file of the report: its figure}, drawn without a warning."""
    heights = self_affine_disc(0.5, 9, seed=1).heights
    group = scaling[scaling["source"] == "discs"].assign(source="measured", case_group="polished")
    arguments = tables.FROM_TABLES | {
        "fig1_surfaces": ([(h, heights, 1 / 9) for h in (0.1, 0.5, 0.9)],),
        "fig2_kinetics": (discs, tables.CASES, scaling, SHOWN),
        "fig3_master_curve": (pooled, pooled[:1], lines, scaling, SHOWN),
        "regions": (pooled, pooled[:1], tables.slopes_table()),
        "measured": ({"polished": pooled[0]}, pooled, group, tables.measured_kinetics(), SHOWN),
    }
    shares = {name: {"fraction_min": 0.95} for name, rule in FIGURES.items() if "fraction_min" in RULES[rule]}
    with warnings.catch_warnings(action="error"):
        return {
            name: tables.plot(tables.MODULES[name], *given, **shares.get(name, {})) for name, given in arguments.items()
        }
