"""Tables of exponents and velocities on fine grids, made from curves of a known law."""

import numpy as np
import pytest

from viscorough.io.netcdf import Content, Variable
from viscorough.reference import exponent_beta
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.ensembles.flat_punch import punch_stiffness
from viscorough_study.fits.fine_grids import COSTS, EXPONENTS, VELOCITIES, finding, fine_grids, judged_decade

HURST, GRIDS, SURFACES = 0.4, (33, 65, 129, 257), (400, 100, 50, 25)
X = abscissa(1e-5, 0.6, 20)


def law_curves(exponent, *, correction=0.05):
    """Return curves vt/h = X^β on every grid, plus a correction to β that halves from grid to grid, and scatter."""
    contents, random = [], np.random.default_rng(1)
    for position, across in enumerate(GRIDS):
        elements = [across, *GRIDS[position - 1 : position]] if position else [across]
        scatter = 0.05 * random.standard_normal((SURFACES[position], 1, 1)) * np.log(X)
        apart = 1e-4 * random.standard_normal((SURFACES[position], len(elements), 1)) * np.log(X)
        slopes = np.array([exponent + correction * 0.5 ** GRIDS.index(n) for n in elements])[:, None]
        logarithm = slopes * np.log(X) + scatter + apart
        count = np.broadcast_to(np.ceil(X * across**1.4), logarithm.shape)
        values = {
            "log_velocity": (("surface", "grid", "abscissa"), logarithm),
            "contact_count": (("surface", "grid", "abscissa"), count),
            "processor_s": (("surface", "grid"), np.broadcast_to(np.array(elements) ** 2 * 1e-6, logarithm.shape[:2])),
            "elements": (("grid",), np.array(elements)),
            "hurst": ((), np.array(HURST)),
            "x": (("abscissa",), X),
        }
        contents.append(Content({name: Variable(*value, {}) for name, value in values.items()}, {}))
    return contents


def tables(exponent, **options):
    return fine_grids(law_curves(exponent, **options), elements_min=5, tolerance=0.05, seed=1)


@pytest.fixture(scope="module")
def made():
    return tables(exponent_beta(HURST))


def test_tables_have_the_described_columns(made):
    for name, columns in {"fine_exponents": EXPONENTS, "fine_velocities": VELOCITIES, "fine_costs": COSTS}.items():
        assert list(made[name]) == list(columns)


def test_exponent_of_the_finest_grid_and_its_limit_are_those_of_the_law(made):
    (row,) = made["fine_exponents"].query("judged == 1 and quantity == 'whole'").to_dict("records")
    assert row["beta_low"] < row["expected"] + 0.05 / 8 < row["beta_high"]
    assert row["limit"] == pytest.approx(row["beta"] - 0.05 / 8, abs=0.002)
    assert row["ratio"] == pytest.approx(0.5, abs=0.02)
    assert row["finding"] == "tends"
    assert row["base"] == GRIDS[0]


@pytest.mark.parametrize(("apart", "expected"), [(0.2, "departs"), (0.05, "undecided")])
def test_finding_of_another_law(apart, expected):
    judged = tables(exponent_beta(HURST) + apart)["fine_exponents"].query("judged == 1 and quantity == 'whole'")
    assert judged["finding"].tolist() == [expected]


def test_decades_begin_where_enough_elements_touch(made):
    for across, rows in made["fine_exponents"].groupby("across"):
        assert rows["touching"].min() >= 5
        assert np.ceil(rows["x_low"].min() * 10**-0.1 * across**1.4) < 5
    judged = made["fine_exponents"].query("judged == 1")["x_low"].unique()
    assert np.ceil(judged * GRIDS[-2] ** 1.4) >= 5  # on the second finest grid
    assert judged_decade([], 5) is not None


def test_interface_is_the_velocity_less_the_punch_of_each_grid(made):
    at = made["fine_velocities"].query("across == 257").pivot(index="x", columns="quantity", values="velocity")
    at = at[at.index < 0.05]
    expected = at["whole"] - at.index / punch_stiffness(257)
    np.testing.assert_allclose(at["interface"], expected, rtol=0.02)  # means of logarithms


def test_cost_of_the_sum_is_compared_with_plain_averaging(made):
    costs = made["fine_costs"]
    assert (costs["cost_ratio"] < 1).all()  # pairs hardly scatter here
    first = costs[costs["x_low"] == costs["x_low"].min()]
    sizes = zip(SURFACES, GRIDS, (0, *GRIDS), strict=False)
    spent = sum(number * (fine**2 + coarse**2) for number, fine, coarse in sizes) * 1e-6
    assert first["sum_s"].tolist() == pytest.approx([spent] * len(first))
    assert first["across"].tolist() == list(GRIDS)


def test_cost_of_a_velocity_is_the_cost_of_all_discs_of_its_sum(made):
    velocities = made["fine_velocities"].query("quantity == 'whole' and across == 257")
    assert velocities["processor_s"].tolist() == pytest.approx([257**2 * 1e-6] * len(velocities))
    for row in velocities.to_dict("records"):
        first = GRIDS.index(row["base"])
        sizes = zip(SURFACES[first:], GRIDS[first:], (0, *GRIDS[first:]), strict=False)
        assert row["sum_s"] == pytest.approx(sum(n * (fine**2 + coarse**2) for n, fine, coarse in sizes) * 1e-6)
        assert row["deviation"] == pytest.approx(-0.05 * np.log(row["x"]), rel=0.4)  # of 25 discs
        assert row["error"] == pytest.approx(-0.05 * np.log(row["x"]) / np.sqrt(SURFACES[first]), rel=0.2)


@pytest.mark.parametrize(
    ("limit", "rise", "expected"),
    [
        ((0.3, 0.28, 0.32), (-0.01, -0.02, 0.0), "tends"),
        ((0.3, 0.28, 0.32), (0.02, 0.01, 0.03), "undecided"),
        ((0.3, 0.24, 0.36), (-0.01, -0.02, 0.0), "undecided"),
        ((0.4, 0.38, 0.42), (-0.01, -0.02, 0.0), "departs"),
        ((np.nan,) * 3, (-0.01, -0.02, 0.0), "undecided"),
        ((0.3, 0.28, 0.32), (np.nan,) * 3, "undecided"),
    ],
)
def test_criterion_of_the_limit(limit, rise, expected):
    assert finding(limit, rise, 0.3, 0.05) == expected
