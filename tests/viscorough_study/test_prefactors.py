"""The prefactor in every combination of conventions: scaling by the factor, and the nearest combination."""

import numpy as np
import pytest

from support.study import SHOWN, evidence
from viscorough.reference import zeta_elastic
from viscorough_study.prefactors import COLUMNS, combinations, prefactors, ranked, rows_of


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


def test_combinations_are_ranked_by_their_largest_deviation(table):
    ranking = ranked(table, "eq4")
    assert (ranking[0]["rms_convention"], ranking[0]["gamma"], ranking[0]["diameter_convention"]) == (
        "square",
        "without",
        "diameter",
    )
    assert ranking[0]["factor"] == 1
    deviations = [rows_of(table, combination)["worst_eq4"].iloc[0] for combination in ranking]
    assert deviations == sorted(deviations)
    assert deviations[0] < 0.05
    assert len(ranking) == len({tuple(combination.values()) for combination in ranking}) == len(combinations(table))
    assert ranked(table.assign(worst_eq4=np.nan), "eq4") == []


def test_combination_without_all_exponents_is_not_compared(table):
    scaling = evidence().scaling
    missing = (scaling["source"] == "discs") & (scaling["hurst"] == 0.6) & (scaling["window_rule"] == "kappa")
    found = prefactors(scaling.assign(zeta=scaling["zeta"].mask(missing)))
    assert found.loc[found["window_rule"] == "kappa", "worst_eq4"].isna().all()
    assert found.loc[found["window_rule"] == "default", "worst_eq4"].notna().all()
