"""What `make bench` measures is what it says, on small problems."""

import json
import pkgutil

import curves
import measuring
import members
import pytest
from click.testing import CliRunner

from support.workflow import merged, read_settings
from viscorough import self_affine_disc


def test_the_command_writes_machine_and_measurements(tmp_path, monkeypatch):
    for name, value in measuring.ENVIRONMENT.items():  # else it would start again
        monkeypatch.setenv(name, value)
    output = tmp_path / "new/file.json"
    main = measuring.command(lambda repeats: {"twice": 2 * repeats}, repeats=3)
    outcome = CliRunner().invoke(main, ["--output", str(output)])
    assert outcome.exit_code == 0, outcome.output
    content = json.loads(output.read_text())
    assert (content["repeats"], content["twice"]) == (3, 6)
    assert content["machine"]["cores"] > 0


def test_every_part_takes_time_and_is_restored():
    """The dense solver and the grid, on a disc of enough elements for both."""
    for names in curves.PARTS_OF_LINE.values():
        assert all(callable(pkgutil.resolve_name(name)) for name in names)
    functions = [pkgutil.resolve_name(name) for names in curves.PARTS_OF_CURVE.values() for name in names]
    disc = self_affine_disc(0.6, 65, seed=1)
    with curves.stopwatch(curves.PARTS_OF_CURVE) as seconds:
        curves.indent(disc)
    assert all(seconds.values())
    assert functions == [pkgutil.resolve_name(name) for names in curves.PARTS_OF_CURVE.values() for name in names]
    shares = curves.shares(lambda: curves.indent(disc), curves.PARTS_OF_CURVE)
    assert sum(share for part, share in shares.items() if part != "processor_s") == pytest.approx(1)


def test_costs_are_compared_on_one_problem():
    (line,) = curves.lines([0.6], 1, points=2000)
    assert line["over_transform"] > 0
    assert curves.rectangles([1.0, 5.0], 1, elements=17)[1.0] == 1
    assert set(curves.large_map(33)) == {"curve", "contact"}


def test_members_are_compared_with_whole_curves():
    """Errors of single discs stay below the tolerance in the depth, whose derivative is κ, and partly cancel."""
    settings = merged(merged(read_settings("config"), read_settings("test")), {"discs": {"hurst": [0.9]}})
    (values,) = members.measured(6, settings)["hurst"].values()
    assert values["ratio"] == pytest.approx(values["member_s"] / values["curve_s"])
    assert values["mean_error"] < values["disc_error"] < 3 * settings["discs"]["tolerance"]
    assert values["standard_error"] == pytest.approx(values["scatter"] / 2)  # two combinations of two discs
    settings["discs"]["tolerance"] = members.TOLERANCE
    assert members.measured(3, settings)["hurst"]["0.9"]["disc_error"] < 1e-9
