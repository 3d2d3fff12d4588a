"""The table of fits: one row for every convention that needs a fit, from ensembles of given curves."""

import numpy as np
import pandas as pd
import pytest

from support.study import LIMITS, SHOWN, aggregate, ensemble_of, pool_of, three_regions
from viscorough import reference
from viscorough.law import calibrated_law
from viscorough.mdr import reduce
from viscorough.surfaces.lines import self_affine_line
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.fits.conventions import FITTED, GAMMA, select, zeta_scale
from viscorough_study.fits.fit_table import COLUMNS, calibrated, fit_rows
from viscorough_study.fits.intervals import with_interval
from viscorough_study.fits.power_law import fit_power_law
from viscorough_study.run.seeds import realization_seed

X = abscissa(1e-7, 10, 20)
BOOTSTRAP = {"resamples": 400, "seed": 1}
DISCS = ensemble_of(X, three_regions(X) * np.exp(0.2 * np.random.default_rng(9).normal(size=(8, 1))))
LINES = ensemble_of(X, np.tile(1.3 * three_regions(X), (9, 1)), conventions=["line"])


def fitted(ensemble, **changes):
    options = {"source": "discs", "group": "base", "stiffness_range": (0.03, 0.3)}
    return fit_rows(ensemble, **(options | LIMITS | BOOTSTRAP | changes))


def test_table_has_a_row_for_every_fit():
    rows = fitted(DISCS, lines=LINES)
    assert len(rows) == len({tuple(row[name] for name in FITTED) for row in rows}) == 2 * 4
    for row in rows:
        assert list(row) == list(COLUMNS)
        assert row["decades"] == pytest.approx(np.log10(row["x_high"] / row["x_low"]))
        assert row["realizations"] == 8
    row = next(r for r in rows if r["average"] == "geometric" and r["window_rule"] == "default")
    zeta = DISCS.isel(rms_convention=0).stiffness_geometric.values[100] / X[100] ** 0.6
    assert row["zeta"] == pytest.approx(zeta, rel=1e-9)
    assert all(np.isnan(without["lambda"]) for without in fitted(DISCS))
    assert row["lambda"] == pytest.approx(np.pi * (1.3 * 1.2 / zeta) ** (2 / 0.6), rel=1e-9)


@pytest.mark.parametrize("gamma", GAMMA)
def test_reading_agrees_with_a_fit_in_its_convention(gamma):
    """ζ and its interval agree with a fit in that reading. One of two groups of surfaces is selected."""
    table = pd.DataFrame(fitted(DISCS) + fitted(DISCS, group="corners"))
    wanted = SHOWN | {"gamma": gamma, "group": "corners"}
    (row,) = select(table, wanted).to_dict("records")
    assert {name: row[name] for name in wanted} == wanted
    window = row["x_low"], row["x_high"]
    betas, zetas = fit_power_law(X, DISCS["velocity"].values[0], window, average="geometric", **BOOTSTRAP)
    zeta = row["zeta"], row["zeta_low"], row["zeta_high"]
    expected = with_interval(zeta_scale(betas, gamma) * zetas, 8)
    assert (row["beta"], *zeta) == pytest.approx((betas[0], *expected), rel=1e-12)


def test_lines_that_do_not_reach_give_no_lambda():
    short = LINES.copy(deep=True)
    short["velocity"][0, 0, X > 3e-7] = np.nan
    assert all(np.isnan(row["lambda"]) and np.isfinite(row["beta"]) for row in fitted(DISCS, lines=short))


def test_without_a_region_rows_have_no_numbers():
    rows = fitted(ensemble_of(X, np.ones((4, X.size))))
    assert len(rows) == 8
    for row in rows:
        assert row["decades"] == 0
        assert all(np.isnan(row[name]) for name in ("x_low", "x_high", "beta", "zeta", "lambda"))


def test_calibration_has_base_discs_and_lines_in_the_conventions_shown():
    rows = fitted(DISCS, lines=LINES) + fitted(DISCS, group="roll_off") + fitted(LINES, source="lines")
    law = pool_of([DISCS.assign_coords(hurst=hurst) for hurst in (0.7, 0.8)], "law")
    options = {"stiffness_range": (0.03, 0.3), **LIMITS, **BOOTSTRAP}
    table = calibrated(pd.DataFrame(rows), law, conventions=SHOWN | {"gamma": "with"}, **options)
    assert list(table) == list(calibrated_law.COLUMNS)
    assert table["source"].tolist() == ["discs", "discs", "lines"]
    assert table["hurst"].tolist() == [0.7, 0.8, 0.7]  # the further discs add only the exponent that the table lacks
    assert table["lambda"].notna().tolist() == [True, False, False]


def test_lines_of_self_affine_roughness_have_the_exponent_of_the_paper():
    """β = H/(1 + H) (Eq. 10) at H = 0.7, by the MDR, to 0.03.

    The bootstrap gives a standard error of 0.008 for 40 lines; the rest allows for the curvature that 13 octaves of
    roughness leave. The halves of the window have twice the error and twice the limit.
    """
    curves = [reduce(self_affine_line(0.7, 2**14, seed=realization_seed(1, 3, i))) for i in range(40)]
    rows = fitted(aggregate(curves, {"line": 1.0}, 1.0, X, hurst=0.7, ensemble="lines"), source="lines")
    by_window = {row["window_rule"]: row for row in rows if row["average"] == "geometric"}
    for window, error in (("default", 0.03), ("lower_half", 0.06), ("upper_half", 0.06)):
        assert by_window[window]["beta"] == pytest.approx(reference.exponent_beta(0.7), abs=error)
    assert by_window["default"]["decades"] > 3
    assert by_window["default"]["beta_high"] - by_window["default"]["beta_low"] < 0.06
