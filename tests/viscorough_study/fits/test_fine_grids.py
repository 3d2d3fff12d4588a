"""Table of exponents on fine grids, made from curves of a known law."""

import numpy as np
import pytest
import xarray as xr

from support.workflow import ROOT
from viscorough.reference import exponent_beta
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.ensembles.flat_punch import punch_stiffness
from viscorough_study.fits.fine_grids import EXPONENTS, LAST_ELEMENTS, _Curves, finding, fine_exponents
from viscorough_study.fits.fine_sentence import fine_grids_sentence, judged_rows

HURST, GRIDS, DISCS = 0.4, (33, 65, 129, 257), (400, 100, 50, 25)
X = abscissa(1e-5, 0.1, 20)


def dataset(elements, logarithm, x=X):
    axes = ("surface", "side", "grid", "abscissa")
    count = np.ceil(3.8 * x * np.array(elements)[:, None] ** 1.4)
    values = {
        "log_velocity": (axes, logarithm),
        "contact_count": (axes, np.broadcast_to(count, logarithm.shape)),
        "elements": (("grid",), np.array(elements)),
        "hurst": ((), np.array(HURST)),
        "x": (("abscissa",), x),
    }
    return xr.Dataset(values)


def law_curves(exponent, *, correction=0.02, scatter_of_grids=0.0015):
    """Return curves vt/h = X^β on every grid, plus a correction to β that halves from grid to grid, and scatter."""
    datasets, random = [], np.random.default_rng(1)
    for position, discs in enumerate(DISCS):
        elements = GRIDS[position::-1]
        slopes = exponent + correction * 0.5 ** np.array([GRIDS.index(across) for across in elements])
        slopes = slopes + 0.03 * random.standard_normal((discs, 2, 1))
        slopes = slopes + scatter_of_grids * random.standard_normal((discs, 2, len(elements)))
        datasets.append(dataset(elements, slopes[..., None] * np.log(X)))
    return datasets


def table(exponent, **options):
    return fine_exponents(law_curves(exponent, **options), elements_min=20, seed=1, sets=100)


@pytest.fixture(scope="module")
def made():
    return table(exponent_beta(HURST))


def test_table_has_the_described_columns(made):
    assert list(made) == list(EXPONENTS)


def test_exponent_of_the_finest_grid_and_its_limit_are_those_of_the_law(made):
    (row,) = made.query("judged == 1 and quantity == 'whole'").to_dict("records")
    assert row["across"] == GRIDS[-1]
    assert row["beta_low"] < row["expected"] + 0.02 / 8 < row["beta_high"]
    assert row["limit_low"] < row["expected"] < row["limit_high"]
    assert row["finding"] == "within"
    assert row["power"] > 0.9
    assert 0.9 <= row["coverage"] <= 1


@pytest.mark.parametrize(
    ("apart", "scatter", "expected"), [(0.1, 0.0015, "outside"), (-0.1, 0.0015, "outside"), (0.0, 0.05, "open")]
)
def test_finding_of_another_law_and_of_grids_that_differ_at_random(apart, scatter, expected):
    judged = table(exponent_beta(HURST) + apart, scatter_of_grids=scatter).query("judged == 1 and quantity == 'whole'")
    assert judged["finding"].tolist() == [expected]


def test_judged_decade_starts_where_enough_elements_touch_on_the_second_finest_grid(made):
    (judged,) = made.query("judged == 1")["x_low"].unique()
    assert np.ceil(3.8 * judged * GRIDS[-2] ** 1.4) >= 20 > np.ceil(3.8 * judged * 10**-0.1 * GRIDS[-2] ** 1.4)
    assert (made["touching"] >= 20).all()


def test_limit_needs_elements_on_the_second_finest_grid(made):
    finest = made.query("finest == 1 and quantity == 'whole'")
    enough = np.ceil(3.8 * finest["x_low"] * GRIDS[-2] ** 1.4) >= LAST_ELEMENTS
    assert 0 < enough.sum() < len(enough)
    assert (finest["limit"].notna() == enough).all()


def test_batches_of_a_nest_are_joined(made):
    datasets = law_curves(exponent_beta(HURST))
    last = datasets.pop()
    values = last["log_velocity"].values
    parts = [dataset(GRIDS[::-1], values[:10]), dataset(GRIDS[::-1], values[10:])]
    assert fine_exponents([*datasets, *parts], elements_min=20, seed=1, sets=100).equals(made)


def test_interface_is_the_velocity_less_the_punch_of_each_grid():
    logarithm = np.full((25, 2, 2, len(X)), 0.3 * np.log(X)) + np.linspace(-1, 1, 25)[:, None, None, None]
    nest = _Curves((257, 129), [dataset((257, 129), logarithm)]).slopes("interface", len(X) - 21, len(X) - 1)
    for position, across in enumerate(nest.grids):
        interface = np.log(np.exp(logarithm[0, 0, position, -21:]) - X[-21:] / punch_stiffness(across))
        assert nest.values[0, position] == pytest.approx(np.polyfit(np.log(X[-21:]), interface, 1)[0])
    assert nest.values[0, 0] != nest.values[0, 1]


@pytest.mark.parametrize(
    ("limit", "expected"),
    [
        ((0.30, 0.271, 0.329), "within"),
        ((0.30, 0.269, 0.329), "open"),
        ((0.30, 0.271, 0.331), "open"),
        ((0.35, 0.331, 0.38), "outside"),
        ((0.25, 0.22, 0.269), "outside"),
        ((np.nan,) * 3, "open"),
    ],
)
def test_criterion_of_the_limit(limit, expected):
    assert finding(limit, 0.3) == expected


def test_sentence_names_every_hurst_exponent_of_the_published_table():
    rows = judged_rows(ROOT)
    sentence = fine_grids_sentence(rows)
    assert [row["hurst"] for row in rows] == [0.1, 0.4, 0.6, 0.9, 1]
    assert all(f"{row['hurst']:g}" in sentence for row in rows)
