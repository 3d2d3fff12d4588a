"""Laws of the prefactor by one measure: given factors and shapes, differences, and undefined comparisons."""

import dataclasses

import numpy as np
import pytest
from scipy import stats
from scipy.special import gamma as gamma_function

from support.study import BOOTSTRAP, HURST, LIMITS, evidence, evidence_with_factors
from viscorough import reference
from viscorough_study.fits.zeta_laws import COLUMNS, LAWS, measure_value, zeta_laws

MEASURES = "deviation", "common factor", "spread"
FOUR, VISCOUS, ELEVEN = LAWS  # Eq. 4 without and with Γ, Eq. 11 with Γ


def compared(sample, *hurst_mins):
    return zeta_laws(sample.pooled, sample.regions, hurst_mins or (0.0,), average="geometric", **BOOTSTRAP)


def measures(table, quantity, law, hurst_min=0.0):
    """Return the values of the three measures."""
    return [measure_value(table, quantity, law, measure, hurst_min)[0] for measure in MEASURES]


def test_measures_separate_a_common_factor_from_the_shape():
    """With 1.3 times Eq. 4, the curves lie 1.3 times below the law, and their ratios are equal."""
    table = compared(evidence(lambda hurst: 1.3 * reference.zeta_elastic(hurst)))
    assert list(table) == list(COLUMNS)
    assert measures(table, "zeta", FOUR) == pytest.approx([np.log(1.3), 1.3, 0], abs=0.02)
    assert measures(table, "curve", FOUR) == pytest.approx([np.log(1.3), 1 / 1.3, 0], abs=0.02)
    gamma = gamma_function(1 + reference.exponent_beta(np.array(HURST)))
    assert measures(table, "zeta", VISCOUS)[1] == pytest.approx(1.3 * np.exp(-np.log(gamma).mean()), abs=0.02)
    for quantity in ("zeta", "curve"):
        for law in LAWS:
            deviation, factor, spread = measures(table, quantity, law)
            assert deviation**2 == pytest.approx(np.log(factor) ** 2 + spread**2, abs=2e-3)


def test_realizations_of_each_hurst_exponent_are_drawn_independently():
    """The common factor is a mean over Hurst exponents, so the errors of independent ensembles add up in it."""
    sample = evidence_with_factors(0.2)
    table = zeta_laws(sample.pooled, sample.regions, average="geometric", resamples=1000, seed=1)
    error = stats.t.ppf(0.975, 79) * 0.2 / np.sqrt(80) / np.sqrt(len(HURST))
    for quantity in ("zeta", "curve"):
        _, low, high = measure_value(table, quantity, FOUR, "common factor")
        assert np.log(high / low) / 2 == pytest.approx(error, rel=0.1)


def test_spread_of_curves_is_taken_at_equal_abscissae():
    """With another exponent, curves of all H drift from the law alike: the deviation grows, the spread does not."""
    straight, bent = (compared(evidence(bent=bent)) for bent in (0.0, 0.06))
    assert measures(bent, "curve", FOUR)[0] > measures(straight, "curve", FOUR)[0] + 0.1
    assert measures(bent, "curve", FOUR)[2] == pytest.approx(measures(straight, "curve", FOUR)[2], abs=0.01)


def test_smallest_exponent_limits_the_comparison():
    sample = evidence(lambda hurst: reference.zeta_elastic(hurst) * (1.5 if hurst < 0.5 else 1.0))
    table = compared(sample, 0.0, 0.6)
    assert measures(table, "zeta", FOUR, 0.6) == pytest.approx([0, 1, 0], abs=0.02)
    assert measures(table, "zeta", FOUR)[2] > 0.15


def test_comparison_without_common_data_is_undefined():
    sample = evidence()
    nowhere = dataclasses.replace(sample, limits=LIMITS | {"elements_min": 10**9})
    assert compared(nowhere)["value"].isna().all()
    assert compared(sample, 2.0)["value"].isna().all()
    apart = dict(zip(HURST, ((1e-5, 1e-4), (1e-4, 1e-3), (1e-3, 1e-2)), strict=True))
    table = zeta_laws(sample.pooled, apart, average="geometric", **BOOTSTRAP).set_index("quantity")
    assert table.loc["curve", ["value", "low"]].isna().all(axis=None)
    assert table.loc["zeta", "value"].notna().all()
