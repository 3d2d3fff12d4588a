"""Damaged files and wrong settings under the workflow."""

import re

import pytest

from support.faults import DAMAGES
from support.workflow import TEST, snakemake

TARGET = "results/ensembles/lines.nc"
CURVES = "results/curves/lines/h04000/0000-0001.nc"


def test_damaged_input_of_a_rule_is_named_and_can_be_made_again(finished):
    curves = finished / CURVES
    whole = curves.read_bytes()
    damaged = DAMAGES["second half zeros"](whole)
    curves.write_bytes(damaged)
    output = snakemake(finished, *TEST, "--forcerun", "aggregate_curves", "--", TARGET, fails=True)
    assert re.search("ERROR (.*)", output)[1].startswith(f"ValueError: {CURVES}: not readable (")
    assert curves.read_bytes() == damaged
    assert not (finished / TARGET).exists()
    curves.unlink()
    snakemake(finished, *TEST, "--", TARGET)
    assert curves.read_bytes() == whole
    assert (finished / TARGET).exists()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("# nothing\n", "Config file must be given as JSON or YAML with keys at top level."),
        ("discs: {hurst: [0.4\n", "Config file is not valid JSON or YAML."),
        ("discs: {elemnts: 33}\n", "unknown key 'elemnts' in discs; did you mean elements?"),
        ("measured: [{name: scan, files: [z.npy]}]\n", "Error in the settings: measured: no file z.npy of scan; "),
    ],
    ids=["empty", "broken", "misspelt", "no scan"],
)
def test_wrong_settings_are_one_line_without_a_traceback(unmade, tmp_path, content, message):
    (tmp_path / "mine.yaml").write_text(content)
    output = snakemake(unmade, "--dry-run", "--configfile", tmp_path / "mine.yaml", fails=True)
    assert message in output.rstrip().splitlines()[-1]
    assert "Traceback" not in output
    assert len(output.splitlines()) <= 3  # besides it: the profile in use, and "WorkflowError:" by Snakemake itself
