"""The interface and the punch in series, on curves whose interface is known."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from support.study import pool_of
from viscorough.calibrated_law import X_LOW, interface_depth, interface_velocity
from viscorough_study.ensembles.averages import abscissa, ensemble_dataset
from viscorough_study.ensembles.indentation import punch_stiffness
from viscorough_study.fits.interface import COLUMNS, CURVES, fit_interface, fit_interfaces, group_ensembles

X = abscissa(1e-9, 30, 20)
PUNCH = 0.98
HOW = {"plateau": 0.05, "fraction_min": 0.95, "resamples": 200, "seed": 1}
LAW = (0.35, 0.5, 0.8)


def ensemble(interface, *, scatter=0.05, realizations=40, punch=PUNCH, elements=10**4, hurst=0.5):
    """Discs of which the interface is a function of X, times a factor for each; one element touches below X = 1e-5."""
    factor = np.exp(scatter * np.random.default_rng(3).standard_normal((realizations, 1)))
    first = 1e-5
    softness = np.where(
        first > X, (first / punch + factor * interface(first)) / first, 1 / punch + factor * interface(X) / X
    )
    count = np.where(first > X, 1.0, 20.0 * np.ones_like(softness))
    coordinates = {"hurst": hurst, "case": "c", "diameter": 1.0, "elements": elements}
    return ensemble_dataset(["disc"], X, 1 / softness[None], count[None], coordinates)


def examined(interface, average="arithmetic", **changes):
    options = HOW | {"average": average}
    return fit_interface(ensemble(interface, **changes).sel(rms_convention="disc"), PUNCH, **options)


def test_plateau_is_given_back():
    """A power law up to X = 0.1, and constant from there on."""
    row, _ = examined(lambda x: np.minimum(0.51, 0.51 * (x / 0.1) ** 0.3))
    assert row["u0"] == pytest.approx(0.51, rel=0.02)
    assert row["u0_high"] - row["u0_low"] == pytest.approx(2 * 1.96 * 0.51 * 0.05 / np.sqrt(40), rel=0.3)
    assert row["plateau_low"] == pytest.approx(0.1 * 0.95 ** (1 / 0.3), rel=0.15)
    assert row["plateau_high"] == pytest.approx(X[-1])


@pytest.mark.parametrize("average", ["arithmetic", "geometric"])
def test_law_is_given_back_with_its_depth(average):
    row, curves = examined(lambda x: interface_velocity(x, *LAW), average, scatter=0.0)
    assert [row[name] for name in ("exponent", "peak", "peak_x")] == pytest.approx(LAW, rel=1e-4)
    assert row["kappa_c"] == PUNCH
    assert (row["law_low"], row["law_high"]) == pytest.approx((X_LOW, X[-1]))
    assert row["deviation"] < 1e-4
    # Below X = 1e-5 the velocity is proportional to X, and not that of the law.
    first = 1e-5 / PUNCH + interface_velocity(1e-5, *LAW)
    offset = first - 1e-5 / PUNCH - interface_depth(1e-5, *LAW)
    assert row["depth_offset"] == pytest.approx(offset, rel=0.02)
    assert row["depth_deviation"] < 2e-3
    np.testing.assert_allclose(curves["interface"] + curves["x"] / PUNCH, curves["velocity"])
    np.testing.assert_allclose(curves["law"], curves["velocity"], rtol=1e-4)
    assert curves["x"].min() == X[X >= 1e-5][0], "where more than one element touches"


def test_law_is_fitted_from_five_elements_in_contact_on():
    """Half the velocity where four elements touch does not bend it; the same where five touch does."""
    known = ensemble(lambda x: interface_velocity(x, *LAW), scatter=0.0).sel(rms_convention="disc")
    halved = known["velocity"] * np.where(X < 3e-3, 0.5, 1.0)
    laws = {}
    for touching in (4, 5):
        count = xr.DataArray(np.where(X < 1e-5, 1, np.where(X < 3e-3, touching, 20)), dims="abscissa")
        changed = known.assign(velocity=halved, contact_count_median=count)
        laws[touching] = fit_interface(changed, PUNCH, **HOW, average="geometric")[0]
    assert [laws[4][name] for name in ("exponent", "peak", "peak_x")] == pytest.approx(LAW, rel=1e-4)
    assert laws[4]["law_low"] == pytest.approx(X[X >= 3e-3 * (1 - 1e-9)][0])
    assert laws[5]["exponent"] > 1.1 * LAW[0]


def test_error_of_the_law_contains_the_interval_of_the_mean():
    exact, scattered = (examined(lambda x: interface_velocity(x, *LAW), scatter=s)[0] for s in (0.0, 0.3))
    assert exact["error"] < 1e-4
    assert scattered["deviation"] < 0.05 < scattered["error"] < 0.3


def test_tables_of_every_grid_and_average():
    members = [
        ensemble(lambda x: interface_velocity(x, *LAW), punch=punch_stiffness(n), elements=elements, hurst=h)
        for n, elements, h in ((33, 797, 0.5), (33, 797, 0.7), (65, 3209, 0.5))
    ]
    pool = pool_of(members)
    cases = group_ensembles(pool, "discs", "base", "disc")
    assert [(labels["across"], labels["hurst"]) for labels, _, _ in cases] == [(33, 0.5), (33, 0.7), (65, 0.5)]
    assert len(group_ensembles(pool, "discs", "base", "disc", {0.7})) == 1
    table, curves = fit_interfaces(cases, **HOW)
    assert (list(table), list(curves)) == (list(COLUMNS), list(CURVES))
    assert table["average"].tolist() == ["arithmetic", "geometric"] * 3
    assert np.ptp(table["u0"]) < 0.01
    assert table["kappa_c"].tolist() == [punch_stiffness(n) for n in (33, 33, 33, 33, 65, 65)]
    assert len(curves.groupby(["across", "hurst", "average"])) == len(table)
    assert isinstance(curves, pd.DataFrame)
