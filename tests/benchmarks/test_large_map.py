"""The cost of a large map: the command runs, on a small one."""

import json

from click.testing import CliRunner

from support.benchmarks import load_benchmark

large_map = load_benchmark("large_map")


def test_file_has_the_cost_of_both_questions(tmp_path):
    output = tmp_path / "large.json"
    done = CliRunner().invoke(large_map.main, ["--points", "65", "--output", str(output)], catch_exceptions=False)
    assert done.exit_code == 0, done.output
    rows = json.loads(output.read_text())
    assert rows["curve"]["contact_fraction"] >= large_map.UNTIL_FRACTION
    assert 0.05 < rows["contact"]["contact_fraction"] < 0.4
    assert abs(rows["contact"]["force_balance"]) < 1e-6
    for question in large_map.QUESTIONS:
        assert rows[question]["processor_s"] > 0
        assert 5e7 < rows[question]["peak_bytes"] < 5e8
    for name in ("contact_fraction", "levels", "operator_applications"):
        assert rows["curve_threads"][name] == rows["curve"][name]
    assert rows["contact_threads"]["contact_fraction"] == rows["contact"]["contact_fraction"]
