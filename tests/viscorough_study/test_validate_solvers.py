"""The comparison with exact solutions passes for the methods as they are, and notices when they are not."""

import numpy as np
import pytest

from viscorough.contact.loading_path import indent
from viscorough_study import validate_solvers

GRIDS = (17, 33, 65)
# About twice the errors of the finest grid; those of the default grids are in config/config.yaml.
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
    return validate_solvers.validation_table(GRIDS, LIMITS)


def test_all_cases_pass(table):
    assert validate_solvers.failures(table) == []
    assert table["passed"].all()


def test_table_has_every_case_on_every_grid(table):
    assert list(table.columns) == list(validate_solvers.COLUMNS)
    assert (table.groupby(["case", "quantity"])["elements"].apply(tuple) == GRIDS).all()
    assert set(table["quantity"]) == set(validate_solvers.ORDERS)
    cases = {"disc", "ellipse", "rough_disc"}
    for body in ("sphere", "cone"):
        cases |= {body, f"{body}_constant_force", f"{body}_rising_force", f"{body}_reduction"}
    assert set(table["case"]) == cases


def test_force_is_of_second_order(table):
    """Uniform pressure on square elements, sphere and cone: slope 2 within the scatter of three grids."""
    order = table[table["quantity"] == "force"].groupby("case")["order"].first()
    assert order.between(1.8, 2.3).all()


def test_flat_disc_is_of_first_order(table):
    order = table[table["case"] == "disc"]["order"].iloc[0]
    assert order == pytest.approx(1, abs=0.1)


def test_an_error_above_its_limit_is_named():
    table = validate_solvers.validation_table((33,), dict.fromkeys(LIMITS, 0.1) | {"area": 1e-3})
    failed = validate_solvers.failures(table)
    assert [line.split(":")[0] for line in failed] == ["sphere area", "cone area"]
    assert "allowed: error up to 0.001" in failed[0]
    assert not table[table["quantity"] == "area"]["passed"].any()
    assert table[table["quantity"] != "area"]["passed"].all()


def test_a_solver_that_does_not_converge_is_noticed(monkeypatch):
    """An error that no grid cures is below a generous limit, and yet the order gives it away."""

    def wrong(*arguments, **options):
        curve = indent(*arguments, **options)
        return type(curve)(**vars(curve) | {"force": 1.01 * curve.force})

    monkeypatch.setattr(validate_solvers, "indent", wrong)
    failed = validate_solvers.failures(validate_solvers.validation_table(GRIDS, dict.fromkeys(LIMITS, 0.1)))
    assert {"sphere force", "cone force"} <= {line.split(":")[0] for line in failed}


def test_one_grid_shows_no_order():
    table = validate_solvers.validation_table((33,), dict.fromkeys(LIMITS, 0.1))
    assert np.isnan(table["order"]).all()
    assert table["passed"].all()


def test_limits_must_be_complete():
    with pytest.raises(ValueError, match="needed: force, depth"):
        validate_solvers.validation_table((17,), {"force": 1e-3})
