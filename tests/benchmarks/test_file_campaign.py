"""No file of the campaign is read as a different map, and the campaign notices a reader that is wrong."""

import file_campaign as campaign
import numpy as np
import pytest

from viscorough.surfaces.indenter import Indenter


@pytest.fixture(scope="module")
def some_cases():
    return [case for _, case in campaign.cases(2013, range(400))]


@pytest.fixture(scope="module")
def case(some_cases):
    """Return an unambiguous matrix with a unit and a missing point."""
    return next(
        case
        for case in some_cases
        if case.kind == "matrix" and case.draft.clear and case.unit and np.isnan(case.heights).any()
    )


def test_no_file_is_read_as_a_different_map(some_cases, tmp_path):
    """Repeat a failure with `python benchmarks/file_campaign.py --seed 2013 --only NUMBER`."""
    outcomes = [(number, *campaign.outcome(case, tmp_path)) for number, case in enumerate(some_cases)]
    assert [outcome for outcome in outcomes if outcome[1] in (campaign.WRONG, campaign.UNREAD)] == []


def test_every_kind_of_file_is_tried_and_many_are_unambiguous_or_bad(some_cases):
    assert len({case.kind for case in some_cases}) == len(campaign.KINDS)
    assert sum(case.draft.clear for case in some_cases) > 150
    assert sum(case.draft.bad for case in some_cases) > 20
    for number, again in campaign.cases(2013, [30, 31]):  # independent of the cases before
        assert (again.draft.traits, again.options) == (some_cases[number].draft.traits, some_cases[number].options)


def reader(case, *, shift=0.0, wider=1.0, unit="m", rows=None, filled=False):
    """Make a reader that returns the true heights of a case in metres, or altered ones."""
    heights, (dx, dy) = case.heights * case.unit, case.spacing
    heights = heights + shift * np.nanmax(abs(heights))
    heights = np.nan_to_num(heights) if filled else heights
    return lambda path, **_: Indenter(heights[:rows], dx * wider, dy, length_unit=unit)


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"shift": 1e-9}, "another map"),
        ({"wider": 1 + 1e-9}, "another spacing"),
        ({"unit": "1"}, "another unit"),
        ({"unit": "mm"}, "another map"),
        ({"rows": -1}, "another map"),
        ({"filled": True}, "another map"),
    ],
)
def test_wrong_map_spacing_or_unit_is_noticed(case, tmp_path, monkeypatch, change, what):
    monkeypatch.setattr("viscorough.read_heights", reader(case, **change))
    outcome, why = campaign.outcome(case, tmp_path)
    assert outcome == campaign.WRONG
    assert what in why


def test_profile_read_as_a_map_is_noticed(some_cases, tmp_path, monkeypatch):
    profile = next(case for case in some_cases if case.is_line and case.draft.clear)
    assert campaign.outcome(profile, tmp_path) == (campaign.READ, "")
    monkeypatch.setattr("viscorough.read_heights", lambda path, **_: Indenter(np.eye(3), 1.0))
    assert campaign.outcome(profile, tmp_path) == (campaign.WRONG, "a profile, read as a map")


def test_reading_a_file_that_must_be_refused_is_noticed(case, tmp_path, monkeypatch):
    monkeypatch.setattr("viscorough.read_heights", reader(case))
    monkeypatch.setattr(case.draft, "bad", True)
    outcome, why = campaign.outcome(case, tmp_path)
    assert (outcome, why[:28]) == (campaign.WRONG, "read, though it must be refu")
