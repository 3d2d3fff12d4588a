"""Trends of exponents over the number of elements, on exponents that are known."""

import numpy as np
import pandas as pd
import pytest

from support.study import BOOTSTRAP, SHOWN, ensemble, fit_row
from viscorough.reference import exponent_beta
from viscorough_study.fits.fit_table import COLUMNS as SCALING
from viscorough_study.fits.grid_trends import COLUMNS, FINDINGS, fixed_window_rows, trends

TOLERANCE = 0.03
ELEMENTS = np.array([1e3, 1e4, 1e5, 1e6])


def table(departure, *, hurst=0.1, source="discs", case_group="sizes", half_width=0.01):
    beta = departure + (0.0 if case_group == "controls" else exponent_beta(hurst))
    columns = fit_row(source=source, case_group=case_group, hurst=hurst, realizations=20)
    if source == "lines":
        columns["rms_convention"] = "line"
    values = {"elements": ELEMENTS, "beta": beta, "beta_low": beta - half_width, "beta_high": beta + half_width}
    return pd.DataFrame(columns | values)


@pytest.mark.parametrize(
    ("departure", "half_width", "finding"),
    [
        ([0.1, 0.07, 0.04, 0.01], 0.01, "agrees on the finest grid"),
        ([0.3, 0.25, 0.2, 0.15], 0.01, "departs, and less on finer grids"),
        ([0.15, 0.2, 0.25, 0.3], 0.01, "departs on every grid"),
        ([0.3, 0.25, 0.2, 0.15], 0.115, "departs on every grid"),
        ([np.nan, np.nan, 0.2, 0.15], 0.01, "undetermined"),
        ([0.1, 0.07, 0.04, 0.04], 0.02, "undetermined"),
    ],
)
def test_finding(departure, half_width, finding):
    assert finding in FINDINGS
    for source, case_group in (("discs", "sizes"), ("discs", "controls"), ("lines", "sizes")):
        fits = table(np.array(departure), source=source, case_group=case_group, half_width=half_width)
        trend = trends(fits, SHOWN, TOLERANCE)
        assert list(trend) == list(COLUMNS)
        name = "controls" if case_group == "controls" else source
        assert trend[["finding", "source"]].iloc[0].tolist() == [finding, name]


def test_slope_and_its_interval():
    """Exponents on a line in log₁₀ n; the interval is that of the weighted fit, wider where they scatter more."""
    straight = trends(table(0.3 - 0.05 * np.arange(4)), SHOWN, TOLERANCE).iloc[0]
    assert straight["slope"] == pytest.approx(-0.05)
    half = 1.96 * (0.01 / 1.96) / np.sqrt(np.sum((np.arange(4) - 1.5) ** 2))
    assert straight["slope_high"] - straight["slope"] == pytest.approx(half)
    scattered = trends(table(0.3 - 0.05 * np.arange(4) + 0.05 * np.array([1, -1, -1, 1])), SHOWN, TOLERANCE).iloc[0]
    assert scattered["slope"] == pytest.approx(-0.05)
    assert scattered["slope_high"] - scattered["slope"] > 3 * half


def test_fixed_windows_beside_the_moving_one_in_the_convention_shown():
    fixed = table(np.full(4, 0.2)).assign(window_rule="X = 0.01 to 0.1")
    other = table(np.zeros(4)).assign(average="arithmetic")
    trend = trends(pd.concat([other, table(np.array([0.3, 0.25, 0.2, 0.15])), fixed]), SHOWN, TOLERANCE)
    assert trend["window_rule"].tolist() == ["default", "X = 0.01 to 0.1"]
    assert trend["finding"].tolist() == ["departs, and less on finer grids", "departs on every grid"]


def test_fits_in_windows_of_fixed_x():
    """Of a power law; a window that begins before enough elements are in contact has no fit."""
    labels = {"source": "discs", "case_group": "sizes"}
    options = {"average": "geometric", "rms_convention": "disc", "elements_min": 10, "fraction_min": 0.95, **BOOTSTRAP}
    windows = [(1e-5, 1e-4), (1e-3, 1e-2), (1e-2, 1e-1)]
    rows = fixed_window_rows(ensemble(0.6, "c1", 1.2, scatter=0.0), windows, labels, **options)
    assert [row["window_rule"] for row in rows] == ["X = 0.001 to 0.01", "X = 0.01 to 0.1"]
    assert [row["beta"] for row in rows] == pytest.approx([exponent_beta(0.6)] * 2)
    assert (rows[0]["x_low"], rows[0]["x_high"], rows[0]["decades"]) == pytest.approx((1e-3, 1e-2, 1.0))
    assert set(rows[0]) < set(SCALING)
