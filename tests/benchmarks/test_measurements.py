"""What `make bench` measures is what it says, on small problems."""

import json
import pkgutil

import curves
import large_map
import lines
import measuring
import members
import numpy as np
import pytest
import rectangles
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


def test_functions_take_turns():
    calls = []
    functions = [lambda: calls.append("a"), lambda: calls.append("b")]
    assert list(measuring.medians(dict(enumerate(functions)), 2)) == [0, 1]
    assert "".join(calls) == "ababab"


def test_every_part_takes_time_and_is_restored():
    """The dense solver and the grid, on a disc of enough elements for both."""
    for names in curves.PARTS_OF_LINE.values():
        assert all(callable(pkgutil.resolve_name(name)) for name in names)
    functions = [pkgutil.resolve_name(name) for names in curves.PARTS_OF_CURVE.values() for name in names]
    disc = self_affine_disc(0.6, 65, seed=1)
    shares = curves.shares(lambda: curves.indent(disc), curves.PARTS_OF_CURVE)
    assert all(shares[part] > 0 for part in curves.PARTS_OF_CURVE)
    assert sum(share for part, share in shares.items() if part != "processor_s") == pytest.approx(1)
    assert functions == [pkgutil.resolve_name(name) for names in curves.PARTS_OF_CURVE.values() for name in names]
    (row,) = curves.over_operators([0.6], 65, 1)
    assert row["ratio"] > 1


def test_columns_by_ducc0_are_the_same_convolution():
    rows, length = 17, curves.good_length(32)
    spectrum = np.random.default_rng(1).random((length // 2 + 1, 5))
    whole = spectrum[np.minimum(np.arange(length), length - np.arange(length))]
    data = np.random.default_rng(2).random((rows, 5)) + 0j
    expected = curves.ducc0_columns(data, whole)
    curves.ColumnConvolution(rows, spectrum / length, float).apply(data)
    np.testing.assert_allclose(data, expected, rtol=1e-12)


def test_large_map_answers_both_questions():
    result = large_map.measured(1, points=65)
    assert result["curve"]["contact_fraction"] >= large_map.UNTIL_FRACTION
    assert 0.05 < result["contact"]["contact_fraction"] < 0.4


def test_lines_are_compared_with_a_transform():
    result = lines.measured(3, points=2000)
    assert 0 < result["ratio"]["low"] <= result["ratio"]["median"] <= result["ratio"]["high"]
    assert min(result[part] for part in ("waves", "transform", "bins")) > 0


def test_members_are_compared_with_whole_curves():
    """Errors of single discs stay below the tolerance in the depth, whose derivative is κ, and partly cancel."""
    settings = merged(merged(read_settings("config"), read_settings("test")), {"discs": {"hurst": [0.9]}})
    (values,) = members.measured(6, settings)["hurst"].values()
    assert values["ratio"] == pytest.approx(values["member_s"] / values["curve_s"])
    assert values["mean_error"] < values["disc_error"] < 3 * settings["discs"]["tolerance"]
    assert values["standard_error"] == pytest.approx(values["scatter"] / 2)  # two combinations of two discs
    settings["discs"]["tolerance"] = members.TOLERANCE
    assert members.measured(3, settings)["hurst"]["0.9"]["disc_error"] < 1e-9


def test_rectangles_are_compared_with_squares_on_the_same_map():
    costs = rectangles.costs(np.random.default_rng(1).random((24, 24)), 2)
    assert list(costs) == ["1", "2", "0.5", "5", "0.2"]
    assert costs["1"]["over_squares"] == 1
