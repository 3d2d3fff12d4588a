"""Ensembles of small discs and lines, shared by the tests of the figures."""

import pytest

from support.figures import COMBINATIONS, ELEMENTS, HURST, X, ensemble_name
from support.study import aggregate, evidence, pool_of
from viscorough.contact.loading_path import indent
from viscorough.mdr import reduce
from viscorough.surfaces.lines import self_affine_line
from viscorough.surfaces.self_affine import self_affine_disc
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
    """Return an ensemble for every combination, each of two realizations."""
    members = []
    for (hurst, name), pair in curves.items():
        rms, diameter = COMBINATIONS[name]["rms"], COMBINATIONS[name]["diameter"]
        own = ensemble_name(hurst, name)
        members.append(aggregate(pair, {"disc": rms, "square": 1.1 * rms}, diameter, X, hurst=hurst, ensemble=own))
    return members


@pytest.fixture(scope="session")
def pooled(discs):
    return list(ensembles(pool_of(discs), "hurst").values())


@pytest.fixture(scope="session")
def lines():
    result = []
    for hurst in HURST:
        reduced = [reduce(self_affine_line(hurst, 1024, seed=seed)) for seed in (1, 2)]
        result.append(aggregate(reduced, {"line": 1.0}, 1.0, X, hurst=hurst, ensemble="lines"))
    return result


@pytest.fixture(scope="session")
def scaling():
    return evidence().tables["scaling"]
