"""Interface and punch in series, for curves with a given interface."""

import numpy as np
import pytest
import xarray as xr

from support.study import ensemble_of, pool_of
from viscorough.law.calibrated_law import interface_velocity
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.ensembles.flat_punch import punch_stiffness
from viscorough_study.fits.interface import COLUMNS, CURVES, fit_interface, interface_tables

X = abscissa(1e-9, 30, 20)
PUNCH = 0.98
HOW = {"plateau": 0.05, "fraction_min": 0.95, "resamples": 200, "seed": 1}
LAW = (0.7, 0.35, 4.0, 2.0, 60.0)


def ensemble(interface, *, scatter=0.05, realizations=40, punch=PUNCH, elements=10**4, hurst=0.5):
    """Make discs whose interface is a function of X times a factor for each; one element touches below X = 1e-5."""
    factor = np.exp(scatter * np.random.default_rng(3).standard_normal((realizations, 1)))
    first = 1e-5
    at = np.maximum(X, first)
    softness = 1 / punch + factor * interface(at) / at
    return ensemble_of(X, 1 / softness, np.where(first > X, 1.0, 20.0), hurst=hurst, elements=elements)


def examined(interface, **changes):
    return fit_interface(ensemble(interface, **changes).sel(rms_convention="disc"), PUNCH, **HOW)


def test_fit_returns_the_plateau():
    """The interface is a power law up to X = 0.1, and constant from there on."""
    row, _ = examined(lambda x: np.minimum(0.51, 0.51 * (x / 0.1) ** 0.3))
    assert row["u0"] == pytest.approx(0.51, rel=0.02)
    assert row["u0_high"] - row["u0_low"] == pytest.approx(2 * 1.96 * 0.51 * 0.05 / np.sqrt(40), rel=0.3)
    assert row["plateau_low"] == pytest.approx(0.1 * 0.95 ** (1 / 0.3), rel=0.15)
    assert row["plateau_high"] == pytest.approx(X[-1])


def test_fit_returns_the_curve_of_the_interface():
    row, curves = examined(lambda x: interface_velocity(x, *LAW), scatter=0.0)
    assert row["kappa_c"] == PUNCH
    np.testing.assert_allclose(curves["interface"], interface_velocity(curves["x"], *LAW), rtol=1e-4)
    assert curves["x"].min() == X[X >= 1e-5][0], "where more than one element touches"


def test_curves_of_single_elements_have_no_interface():
    alone = ensemble(lambda x: 0.5 * x).sel(rms_convention="disc").isel(abscissa=np.flatnonzero(X < 1e-5))
    row, curve = fit_interface(alone, PUNCH, **HOW)
    assert row == {"realizations": 40, "kappa_c": PUNCH}
    assert curve.empty


def test_tables_have_rows_of_every_exponent():
    """Lines are included if their Hurst exponents occur among the discs. The control has none."""

    def discs(*exponents, elements=797, across=33):
        punch = punch_stiffness(across)
        return [
            ensemble(lambda x: interface_velocity(x, *LAW), punch=punch, elements=elements, hurst=h) for h in exponents
        ]

    lines = [ensemble(lambda x: interface_velocity(x, *LAW), punch=1.0, elements=64, hurst=h) for h in (0.3, 0.7)]
    lines = pool_of(lines, "lines").assign_coords(rms_convention=["line"])
    base = xr.concat([pool_of(discs(0.5, 0.7)), pool_of(discs(0.5), "roll_off")], "realization")
    law = pool_of(discs(0.9, elements=3209, across=65), "law")
    table, curves = interface_tables(base, law, lines, fit=HOW).values()
    assert (list(table), list(curves)) == (list(COLUMNS), list(CURVES))
    assert table["source"].tolist() == ["discs"] * 3 + ["lines"]
    assert table["hurst"].tolist() == [0.5, 0.7, 0.9, 0.7]
    assert np.ptp(table["u0"]) < 0.01
    assert table["kappa_c"].tolist() == [punch_stiffness(n) for n in (33, 33, 65)] + [1.0]
    assert len(curves.groupby(["source", "across", "hurst"])) == len(table)
