"""Tables of lines against discs, from ensembles with given λ(X) and exponents."""

import numpy as np
import pytest

from support.study import LIMITS, ensemble_of
from viscorough_study.comparisons.mdr_equivalence import TABLES, compare_ensembles
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.fits.intervals import with_interval
from viscorough_study.fits.power_law import fit_power_law
from viscorough_study.run.names import WINDOWS

x = abscissa(1e-7, 30, 20)
HOW = {"average": "geometric", "stiffness_range": [0.03, 0.3], "resamples": 50, "seed": 1, **LIMITS}


def ensemble(alpha, seed, *, factor=1.0, elements=10**5, hurst=0.7, spread=0.0):
    """Make an ensemble with κ = factor X^α from one element to complete contact; spread : standard deviation of α."""
    normal = np.random.default_rng(seed).normal(size=(12, 1))
    scatter, alpha = np.exp(0.05 * normal), alpha + spread * normal
    stiffness = np.clip(factor * scatter * x**alpha, 1e-6, 1)
    return ensemble_of(x, stiffness, elements=elements, hurst=hurst).isel(rms_convention=0)


def tables(discs, lines):
    return compare_ensembles({0.7: discs}, {0.5: lines, 0.7: lines}, **HOW).values()


def test_equal_ensembles_give_lambda_pi():
    discs = ensemble(0.6, seed=1)
    lambdas, summary, exponents = all_tables = tables(discs, discs)
    assert list(map(list, all_tables)) == list(map(list, TABLES.values()))
    inside = lambdas[lambdas["in_region"] == 1]
    np.testing.assert_allclose(inside["lambda"], np.pi, rtol=1e-6)
    np.testing.assert_allclose(lambdas["velocity_ratio"], 1, rtol=1e-6)
    (row,) = summary.to_dict("records")
    assert row["drift"] == pytest.approx(1, rel=1e-6)
    assert row["drift_low"] < 1 < row["drift_high"]
    assert row["realizations"] == 12
    assert exponents["window"].tolist() == list(WINDOWS)
    assert exponents["difference"].abs().max() < 1e-9
    few = discs.assign(contact_count_median=discs["contact_count_median"] * 0)  # no region (b)
    lambdas, summary, exponents = tables(few, discs)
    assert lambdas.empty
    assert np.isnan(summary["drift"]).all()
    assert exponents["difference"].notna().tolist() == [window == "same κ" for window in WINDOWS]
    shorter = discs.assign(fraction_defined=discs["fraction_defined"] * 0.99)  # some discs end before region (b)
    lambdas, summary, exponents = tables(shorter, discs)
    assert lambdas.empty
    assert summary[["drift", "error_whole"]].isna().to_numpy().tolist() == [[False, True]]
    assert exponents["difference"].notna().all()


def test_discs_and_lines_are_drawn_independently():
    """Discs and lines are the same curves here. With independent draws the variances of both exponents add up."""
    both = ensemble(0.6, seed=1, spread=0.01)
    exponents = compare_ensembles({0.7: both}, {0.7: both}, **HOW | {"resamples": 500})["mdr_exponents"]
    own = exponents.iloc[0]
    betas, _ = fit_power_law(x, both["velocity"].values, (1e-3, 1e-2), average="geometric", resamples=500, seed=1)
    _, low, high = with_interval(betas, 12)
    assert own["difference_high"] - own["difference_low"] == pytest.approx(np.sqrt(2) * (high - low), rel=0.15)


def test_different_exponents_make_lambda_drift():
    """κ3 = X^0.55 and κ1 = X^0.6: β differs by 0.05, λ by X^(2·0.05/0.6), and vt/h at the ends by half of X^0.05."""
    lambdas, summary, exponents = tables(ensemble(0.55, seed=1), ensemble(0.6, seed=2))
    (row,) = summary.to_dict("records")
    decades = np.ptp(np.log(lambdas.loc[lambdas["in_region"] == 1, "x"]))
    assert row["drift"] == pytest.approx(np.exp(2 * 0.05 / 0.6 * decades), rel=1e-3)
    assert row["error_trend"] == pytest.approx(-0.025 * decades, rel=1e-3)
    same_x = exponents.set_index("window").loc["same X"]
    assert same_x["difference"] == pytest.approx(-0.05, abs=1e-6)
