"""Laws of the prefactor by one measure: given factors and shapes, differences, and undefined comparisons."""

import dataclasses

import numpy as np
import pytest
from scipy import stats
from scipy.special import gamma as gamma_function

from support.study import BOOTSTRAP, HURST, LIMITS, evidence, evidence_with_factors
from viscorough import reference
from viscorough_study.fits.zeta_laws import COLUMNS, LAWS, difference, measure_value, zeta_laws

FOUR, VISCOUS, ELEVEN = LAWS  # Eq. 4 without and with Γ, Eq. 11 with Γ
BETAS = reference.exponent_beta(np.array(HURST))


def compared(sample, *hurst_mins):
    return zeta_laws(sample.pooled, sample.regions, hurst_mins or (0.0,), average="geometric", **BOOTSTRAP)


def measures(table, range_of_x, law, hurst_min=0.0, names=("deviation", "common factor", "residual")):
    """Return the values of some measures."""
    return [measure_value(table, range_of_x, law, name, hurst_min)[0] for name in names]


def test_measures_separate_a_common_factor_from_the_shape():
    """With 1.3 times Eq. 4, the curves lie 1.3 times below the law, and no residual is left."""
    table = compared(evidence(lambda hurst: 1.3 * reference.zeta_elastic(hurst)))
    assert list(table) == list(COLUMNS)
    gamma = gamma_function(1 + BETAS)
    for name in ("region", "common"):
        assert measures(table, name, FOUR) == pytest.approx([np.log(1.3), 1 / 1.3, 0], abs=0.02)
        assert measures(table, name, VISCOUS)[1] == pytest.approx(np.exp(np.log(gamma).mean()) / 1.3, abs=0.02)
        for law in LAWS:
            deviation, factor, residual = measures(table, name, law)
            assert deviation**2 == pytest.approx(np.log(factor) ** 2 + residual**2, abs=1e-9)
            less = measure_value(table, name, difference(law), "deviation")[0] if law != ELEVEN else 0.0
            assert less == pytest.approx(deviation - measures(table, name, ELEVEN)[0], abs=1e-9)


def test_factor_of_x_reconciles_curves_that_differ_by_a_unit_of_x():
    """If vt/h is 1.9^β times the law, a factor on X describes the curves, but no common factor of vt/h does."""
    table = compared(evidence(lambda hurst: reference.zeta_elastic(hurst) / 1.9 ** reference.exponent_beta(hurst)))
    factor, residual, other = measures(
        table, "region", FOUR, names=("factor of X", "residual with factor of X", "residual")
    )
    assert factor == pytest.approx(1.9, rel=0.05)
    assert other == pytest.approx(np.std(BETAS * np.log(1.9)), rel=0.2)
    assert residual < 0.3 * other


def test_realizations_of_each_hurst_exponent_are_drawn_independently():
    """The common factor is a mean over Hurst exponents, so the errors of independent ensembles add up in it."""
    sample = evidence_with_factors(0.2)
    table = zeta_laws(sample.pooled, sample.regions, average="geometric", resamples=1000, seed=1)
    error = stats.t.ppf(0.975, 79) * 0.2 / np.sqrt(80) / np.sqrt(len(HURST))
    for name in ("region", "common"):
        _, low, high = measure_value(table, name, FOUR, "common factor")
        assert np.log(high / low) / 2 == pytest.approx(error, rel=0.1)


def test_spread_of_curves_is_taken_at_equal_abscissae():
    """With another exponent, curves of all H drift from the law alike: the deviation grows, the spread does not."""
    names = "deviation", "spread"
    straight, bent = (measures(compared(evidence(bent=bent)), "common", FOUR, names=names) for bent in (0.0, 0.06))
    assert bent[0] > straight[0] + 0.1
    assert bent[1] == pytest.approx(straight[1], abs=0.01)


def test_smallest_exponent_limits_the_comparison():
    sample = evidence(lambda hurst: reference.zeta_elastic(hurst) * (1.5 if hurst < 0.5 else 1.0))
    table = compared(sample, 0.0, 0.6)
    assert measures(table, "region", FOUR, 0.6) == pytest.approx([0, 1, 0], abs=0.02)
    assert measures(table, "region", FOUR)[2] > 0.15


def test_comparison_without_common_data_is_undefined():
    sample = evidence()
    nowhere = dataclasses.replace(sample, limits=LIMITS | {"elements_min": 10**9})
    assert compared(nowhere)["value"].isna().all()
    assert compared(sample, 2.0)["value"].isna().all()
    apart = dict(zip(HURST, ((1e-5, 1e-4), (1e-4, 1e-3), (1e-3, 1e-2)), strict=True))
    table = zeta_laws(sample.pooled, apart, average="geometric", **BOOTSTRAP).set_index("range")
    assert table.loc["common", ["value", "low"]].isna().all(axis=None)
    assert table.loc["region", "value"].notna().all()
