"""The comparison with exact solutions passes for the present methods and notices wrong ones."""

import pytest

from viscorough_study.comparisons import validation as validate_solvers

GRIDS = (17, 33, 65)
MARGIN = 0.3
ERRORS = ["comparison", "quantity", "elements", "error"]
# The limits are about twice the errors of the finest grid. config/config.yaml has the limits of the default grids.
LIMITS = {
    "force": 5e-4,
    "depth": 8e-4,
    "stiffness": 3e-2,
    "velocity": 6e-3,
    "area": 3e-2,
    "punch_stiffness": 4e-2,
    "correspondence": 1e-9,
}


@pytest.fixture(scope="module")
def table():
    return validate_solvers.validation_table(GRIDS, LIMITS, MARGIN)


def test_every_comparison_passes_on_every_grid(table):
    assert validate_solvers.failures(table, MARGIN) == []
    assert table["passed"].all()
    assert list(table.columns) == list(validate_solvers.COLUMNS)
    assert (table.groupby(["comparison", "quantity"])["elements"].apply(tuple) == GRIDS).all()
    assert set(table["quantity"]) == set(validate_solvers.ORDERS)
    comparisons = {"disc", "ellipse", "rough_disc", "sphere_on_rectangles"}
    for body in ("sphere", "cone"):
        comparisons |= {body, f"{body}_constant_force", f"{body}_rising_force", f"{body}_reduction"}
    assert set(table["comparison"]) == comparisons


def test_an_error_above_its_limit_is_named(table):
    judged = validate_solvers.judge_errors(table[ERRORS], LIMITS | {"area": 1e-4}, MARGIN)
    failed = validate_solvers.failures(judged, MARGIN)
    assert [line.split(":")[0] for line in failed] == ["sphere area", "cone area", "sphere_on_rectangles area"]
    assert "allowed: error up to 0.0001" in failed[0]
    assert (judged["passed"] == (judged["quantity"] != "area")).all()


def test_a_solver_that_does_not_converge_is_noticed(table):
    """An error of 1 % on all grids is below a generous limit, but its order is too low."""
    errors = table[ERRORS].assign(error=table["error"] + 0.01 * (table["quantity"] == "force"))
    judged = validate_solvers.judge_errors(errors, dict.fromkeys(LIMITS, 0.1), MARGIN)
    failed = validate_solvers.failures(judged, MARGIN)
    assert [line.split(":")[0] for line in failed] == ["sphere force", "cone force", "sphere_on_rectangles force"]
