"""The prefactor in every combination of conventions: scaling by the factor, and the nearest combination."""

import numpy as np
import pytest

from support.study import SHOWN, evidence
from viscorough.reference import zeta_elastic
from viscorough_study.prefactors import COLUMNS, combinations, nearest, prefactors, rows_of


@pytest.fixture(scope="module")
def table():
    """Surfaces with ζ twice Eq. 4 in h of the disc, and just Eq. 4 in h of the square."""
    return prefactors(evidence(lambda hurst: 2 * zeta_elastic(hurst), square=0.5).scaling)


def test_factor_is_a_larger_force(table):
    assert list(table) == list(COLUMNS)
    assert len(combinations(table)) == 2 * 2 * 4 * 2 * 2 * 2
    once, twice = (rows_of(table, SHOWN | {"factor": factor}) for factor in (1, 2))
    np.testing.assert_allclose(
        twice["zeta"].values, once["zeta"].values * 2 ** np.array([0.4 / 1.4, 0.6 / 1.6, 0.9 / 1.9])
    )
    np.testing.assert_allclose(once["eq4"], 2, rtol=0.05)
    np.testing.assert_allclose(once["worst_eq4"], np.log(2), atol=0.05)


def test_nearest_combination_is_found(table):
    best = nearest(table, "eq4")
    assert (best["rms_convention"], best["gamma"], best["diameter_convention"], best["factor"]) == (
        "square",
        "without",
        "diameter",
        1,
    )
    assert rows_of(table, best)["worst_eq4"].max() < 0.05
    assert nearest(table.assign(worst_eq4=np.nan), "eq4") is None


def test_combination_without_all_exponents_is_not_compared(table):
    scaling = evidence().scaling
    missing = (scaling["source"] == "discs") & (scaling["hurst"] == 0.6) & (scaling["window_rule"] == "kappa")
    found = prefactors(scaling.assign(zeta=scaling["zeta"].mask(missing)))
    assert found.loc[found["window_rule"] == "kappa", "worst_eq4"].isna().all()
    assert found.loc[found["window_rule"] == "default", "worst_eq4"].notna().all()
