"""The prefactor in every combination of conventions: its deviations from the laws, and the nearest combination."""

import numpy as np
import pandas as pd
import pytest

from support.study import BASE_SURFACES, SHOWN, evidence
from viscorough.reference import zeta_elastic, zeta_viscous
from viscorough_study.fits.prefactors import COLUMNS, combination_rows, combinations, prefactors, ranked

OWN = {"case_group": "base"} | SHOWN


@pytest.fixture(scope="module")
def scaling():
    """Surfaces with ζ twice Eq. 4 in h of the disc, and just Eq. 4 in h of the square."""
    return evidence(lambda hurst: 2 * zeta_elastic(hurst), square=0.5).tables["scaling"]


@pytest.fixture(scope="module")
def table(scaling):
    return prefactors(scaling, BASE_SURFACES)


def test_deviations_from_a_law_with_and_without_a_common_factor(table):
    assert list(table) == list(COLUMNS)
    assert len(combinations(table)) == 2 * 2 * 4 * 2 * 2
    own = combination_rows(table, OWN)
    np.testing.assert_allclose(own["eq4"], 2, rtol=0.05)
    for name in ("worst", "deviation"):
        np.testing.assert_allclose(own[f"{name}_eq4"], np.log(2), atol=0.05)
    np.testing.assert_allclose(own["common_eq4"], 2, rtol=0.03)
    assert (own["shape_eq4"] < 0.02).all()
    logarithm = np.log(own["zeta"] / zeta_viscous(own["hurst"]))
    assert own["deviation_eq11"].iloc[0] == pytest.approx(np.sqrt(np.mean(logarithm**2)), rel=1e-12)
    assert own["common_eq11"].iloc[0] == pytest.approx(np.exp(logarithm.mean()), rel=1e-12)
    assert own["shape_eq11"].iloc[0] == pytest.approx(np.std(logarithm), rel=1e-12)


def test_combinations_are_ranked_by_their_largest_deviation(table):
    ranking = ranked(table, "eq4")
    assert ranking[0]["rms_convention"] == "square"
    assert (ranking[0]["gamma"], ranking[0]["diameter_convention"]) == ("without", "diameter")
    deviations = [combination_rows(table, combination)["worst_eq4"].iloc[0] for combination in ranking]
    assert deviations == sorted(deviations)
    assert deviations[0] < 0.05
    assert len(ranking) == len(combinations(table))
    assert ranked(table.assign(worst_eq4=np.nan), "eq4") == []


def test_surfaces_are_crossed_with_the_other_conventions(scaling):
    """Variants that differ in several conventions at once are combinations of their own; controls are left out."""
    both = {"period": 2.0, "corners": True, "amplitudes": "random"}
    groups = [scaling.assign(case_group=name) for name in ("base", "both", "roll_off")]
    groups[1]["zeta"] *= 1.5
    table = prefactors(pd.concat(groups, ignore_index=True), BASE_SURFACES | {"both": both})
    assert set(table["case_group"]) == {"base", "both"}
    base, crossed = (combination_rows(table, OWN | {"case_group": name}) for name in ("base", "both"))
    assert crossed[["period", "corners", "amplitudes"]].iloc[0].tolist() == [2, "yes", "random"]
    assert crossed["common_eq4"].iloc[0] == pytest.approx(1.5 * base["common_eq4"].iloc[0])
    assert crossed["shape_eq4"].iloc[0] == pytest.approx(base["shape_eq4"].iloc[0])


def test_combination_without_all_exponents_is_not_compared(scaling):
    missing = (scaling["source"] == "discs") & (scaling["hurst"] == 0.6) & (scaling["window_rule"] == "kappa")
    table = prefactors(scaling.assign(zeta=scaling["zeta"].mask(missing)), BASE_SURFACES)
    assert table.loc[table["window_rule"] == "kappa", ["worst_eq4", "shape_eq4", "common_eq11"]].isna().all(axis=None)
    assert table.loc[table["window_rule"] == "default", "worst_eq4"].notna().all()
