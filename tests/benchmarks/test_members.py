"""The benchmark of members of ensembles measures what it says."""

import pytest

from support.workflow import merged, read_settings


def test_members_are_compared_with_whole_curves(script):
    settings = merged(merged(read_settings("config"), read_settings("test")), {"discs": {"hurst": [0.9]}})
    result = script("members").measured(settings, 6)
    (values,) = result["hurst"].values()
    assert result["tolerance"] == settings["discs"]["tolerance"]
    assert values["ratio"] == pytest.approx(values["member_s"] / values["curve_s"])
    assert values["member_s"] > 0
    # Errors of single discs stay below the tolerance in the depth, whose derivative is κ, and partly cancel.
    assert values["mean_error"] < values["disc_error"] < 3 * result["tolerance"]
    assert values["standard_error"] == pytest.approx(values["scatter"] / 2)  # two combinations of two discs


def test_the_tolerance_is_what_makes_the_error(script):
    settings = merged(merged(read_settings("config"), read_settings("test")), {"discs": {"hurst": [0.9]}})
    errors = {}
    for tolerance in (1e-3, 1e-1):
        settings["discs"]["tolerance"] = tolerance
        errors[tolerance] = script("members").measured(settings, 3)["hurst"]["0.9"]["disc_error"]
    assert errors[1e-3] < 1e-9 < errors[1e-1]
