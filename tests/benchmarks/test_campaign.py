"""Random indenters against direct integration: none fails silently, and the campaign counts a silent failure."""

import json

import campaign
import pytest
from click.testing import CliRunner

pytestmark = pytest.mark.long


@pytest.mark.parametrize(
    ("family", "count"),
    [
        ("levels", 120),
        ("curves", 300),
        ("starts", 100),
        ("forces", 100),
        ("large_maps", 50),
        ("whole_discs", 3),
        ("whole_tolerances", 10),
    ],
)
def test_random_indenters_do_not_fail_silently(family, count):
    """Repeat a failure with `python benchmarks/campaign.py --family FAMILY --case NUMBER --seed 12`."""
    failures = {number: campaign.failure(family, 12, number) for number in range(count)}
    assert {number: wrong for number, wrong in failures.items() if wrong} == {}


def test_a_silent_failure_is_counted(monkeypatch, tmp_path):
    monkeypatch.setitem(campaign.FAMILIES, "levels", (lambda random: random.random(), lambda case: "wrong", 1.0))
    output = tmp_path / "campaign.json"
    outcome = CliRunner().invoke(campaign.main, ["--family", "levels", "--cases", "2", "--output", str(output)])
    assert outcome.exit_code == 1
    assert "2 silent failures among 2 cases" in outcome.output
    assert json.loads(output.read_text())["cases"] == {"levels": 2}
