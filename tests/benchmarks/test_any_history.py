"""Cost and accuracy of motions that unload, on small discs."""

import json

import any_history
from click.testing import CliRunner


def test_cost_and_errors_are_written(tmp_path):
    output = tmp_path / "any_history.json"
    sizes = ["--across", "33", "--direct-across", "17", "--contact", "60", "--levels-across", "33", "--levels", "400"]
    outcome = CliRunner().invoke(any_history.main, [*sizes, "--output", str(output)])
    assert outcome.exit_code == 0, outcome.output
    result = json.loads(output.read_text())
    assert result["cost"]["ratio"] > 1
    assert abs(result["cost"]["direct_elements"] - 60) < 20
    assert max(result["levels"].values()) < 2e-3
