"""Random indenters against direct integration: a few are right, and a silent failure is counted and can be repeated."""

import json

import campaign
from click.testing import CliRunner


def test_a_few_random_indenters_are_solved_rightly(tmp_path):
    outcome = CliRunner().invoke(campaign.main, ["--cases", "2", "--output", str(tmp_path / "campaign.json")])
    assert outcome.exit_code == 0, outcome.output
    counts = json.loads((tmp_path / "campaign.json").read_text())["cases"]
    assert counts == {"levels": 2, "curves": 2, "starts": 1, "forces": 2, "large_maps": 2, "audits": 1}


def test_a_silent_failure_is_counted(monkeypatch):
    monkeypatch.setitem(campaign.FAMILIES, "levels", (lambda random: random.random(), lambda case: "wrong", 1.0))
    outcome = CliRunner().invoke(campaign.main, ["--family", "levels", "--case", "7", "--seed", "3"])
    assert outcome.exit_code == 1
    assert "1 silent failures among 1 cases" in outcome.output
