"""The recommended penetration law: its numbers, their origin in tables of fits, its formula and its range."""

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import quad

import viscorough
from support.documentation import ROOT
from viscorough.law import calibrated_law
from viscorough.law.calibrated_law import CONSTANTS, LARGEST_DEVIATION, interface_depth, interface_velocity
from viscorough.reference import one_element_stiffness

HURST = [0.1, 0.4, 0.6, 0.9, 1.0]
TABLE = pd.read_csv(ROOT / "src/viscorough/law/data/law.csv")
LAW = (0.7, 0.35, 4.0, 2.0, 60.0)  # amplitude, exponent, bend, fall, cutoff


# ---- the interface


def test_interface_has_its_limits():
    """One element touches at first; a power law follows; the interface ends in complete contact."""
    x = np.geomspace(1e-12, 1e4, 400)
    values = interface_velocity(x, *LAW)
    assert values[0] / x[0] + 1 == pytest.approx(1 / one_element_stiffness(257), rel=1e-4)
    far = interface_velocity(np.array([1e-6, 1e-5]), *LAW, across=10**12)
    assert np.log(far[1] / far[0]) / np.log(10) == pytest.approx(LAW[1], rel=1e-4)
    assert values[-1] < 1e-16 * x[-1] ** 2
    assert (np.diff(x + values) > 0).all()
    # At this X region (a) has almost no effect.
    assert interface_velocity(4.0, *LAW) == pytest.approx(0.7 * 4**0.35 / 4 / (1 + 1 / 225) ** 4, rel=1e-3)


@pytest.mark.parametrize("x", [1e-6, 1e-2, 0.8, 30.0])
def test_depth_of_the_interface_is_its_integral(x):
    integral = quad(lambda log: interface_velocity(np.exp(log), *LAW), -80, np.log(x), epsabs=0, limit=500)[0]
    assert interface_depth(x, *LAW) == pytest.approx(integral, rel=1e-7)


# ---- the law


def test_numbers_agree_with_the_tables_of_the_calibration():
    table, beyond = calibrated_law.calibration(), calibrated_law.interface_calibration()
    assert set(table) == set(calibrated_law.COLUMNS) - {"source"}
    assert table["hurst"].tolist() == beyond["hurst"].tolist() == HURST
    assert np.all(table["beta_low"] < table["beta"])
    assert np.all(table["beta"] < table["beta_high"])
    fits = pd.read_csv(ROOT / "src/viscorough/law/data/calibration.csv").query("source == 'discs'").set_index("hurst")
    laws = TABLE.query("across == 257").set_index("hurst")
    for hurst in HURST:
        law, fit, row = viscorough.penetration_law(hurst), fits.loc[hurst], laws.loc[hurst]
        for name in ("beta", "zeta"):
            assert (getattr(law, name), *getattr(law, f"{name}_interval")) == tuple(
                fit[[name, f"{name}_low", f"{name}_high"]]
            )
        assert law.region == pytest.approx(tuple(fit[["x_low", "x_high"]]))
        for name in (*CONSTANTS, "velocity_error", "depth_error", "x_low", "x_high"):
            assert getattr(law, name) == pytest.approx(row[name], rel=1e-12), name
        assert law.velocity(1.0) == pytest.approx(1 + interface_velocity(1.0, *(row[name] for name in CONSTANTS)))


def test_law_has_both_integrals_and_the_required_accuracy():
    assert (TABLE["deviation"] <= LARGEST_DEVIATION).all()
    assert (TABLE["x_low"] < 1).all()
    assert (TABLE["x_high"] > 1).all()
    log_x = np.linspace(-20, 8, 4001)
    for row in TABLE.itertuples():
        law = interface_velocity(np.exp(log_x), *(getattr(row, name) for name in CONSTANTS), across=row.across)
        assert np.trapezoid(law, log_x) == pytest.approx(row.mean_gap, rel=1e-4)
        assert np.trapezoid(law * np.exp(log_x), log_x) == pytest.approx(row.energy, rel=1e-4)


def test_numbers_are_interpolated_between_calibrated_exponents():
    law, low, high = (viscorough.penetration_law(hurst) for hurst in (0.5, 0.4, 0.6))
    for name in ("beta", "zeta", "amplitude", "exponent", "fall", "velocity_error", "depth_error"):
        assert getattr(law, name) == pytest.approx((getattr(low, name) + getattr(high, name)) / 2)
    assert law.cutoff == pytest.approx(np.sqrt(low.cutoff * high.cutoff))
    assert law.region[0] == pytest.approx(np.sqrt(low.region[0] * high.region[0]))


def test_values_outside_the_calibrated_range_are_refused():
    law = viscorough.penetration_law(0.6)
    for x in (0.9 * law.x_low, 1.1 * law.x_high, np.nan):
        for function in (law.velocity, law.depth):
            with pytest.raises(ValueError, match=rf"X of the law for H = 0.6: .* allowed: {law.x_low:.3g} to"):
                function([1.0, x])
    for hurst in (0.05, 1.01):
        with pytest.raises(ValueError, match=r"argument hurst: must be from 0.1 to 1 for the penetration law"):
            viscorough.penetration_law(hurst)
