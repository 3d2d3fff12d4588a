"""Damaged files and wrong settings under the workflow."""

import os
import re
import shlex
import subprocess
import sys

import netCDF4
import pytest

from support.faults import DAMAGES
from support.workflow import ROOT, TEST, copy_project, environment, plan, snakemake

TARGET = "results/ensembles/lines.nc"
CURVES = "results/curves/lines/h04000/0000-0001.nc"


def test_error_names_a_damaged_input_that_can_be_made_again(finished):
    curves = finished / CURVES
    whole = curves.read_bytes()
    with netCDF4.Dataset(curves, "r+") as file:
        file["depth"][0] *= 2
    damaged = curves.read_bytes()
    tries = ("--retries", "1", "--default-resources", "tries=attempt")
    output = snakemake(finished, *TEST, *tries, "--forcerun", "aggregate_curves", "--", TARGET, fails=True)
    assert "not tried again after an error: " in output
    message = re.search("ERROR (.*)", output)[1]
    assert message.startswith(f"aggregate_curves, {TARGET}: ValueError: {CURVES}: not readable (")
    assert message.endswith("; remove the file, so that the next run makes it again")
    assert curves.read_bytes() == damaged
    assert not (finished / TARGET).exists()
    curves.unlink()
    snakemake(finished, *TEST, "--", TARGET)
    assert curves.read_bytes() == whole
    assert (finished / TARGET).exists()


@pytest.mark.parametrize("damage", DAMAGES)
def test_file_without_a_readable_record_is_made_again(finished, damage):
    curves = finished / CURVES
    curves.write_bytes(DAMAGES[damage](curves.read_bytes()))
    assert plan(finished, *TEST, "--", TARGET)["reduce_lines"] == 1


@pytest.mark.parametrize("kind", ["lines", "discs"])
def test_batch_outside_of_the_settings_is_refused(unmade, kind):
    """Such a batch would hold fewer realizations than its name says."""
    output = snakemake(unmade, *TEST, "--dry-run", "--", f"results/curves/{kind}/h04000/0000-0005.nc", fails=True)
    message = "Error: batch 0000-0005 of h04000 is not one of the settings; allowed: 0000-0001"
    assert output.splitlines()[-1].startswith(message)
    assert "Traceback" not in output


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"seed: 0123\n", ": not readable (0123 begins with a zero"),
        (b"discs: {elemnts: 33}\n", ": discs.elemnts: unknown key; did you mean elements?"),
        (b"curves: {x_low: 1.0}\n", ": curves: x_low and short_until_x: 1 and 1.8; the second must be at least ten"),
        (b"measured: [{name: scan, files: [z.npy]}]\n", ": measured, scan: there is no file z.npy in /"),
    ],
    ids=["octal", "misspelt", "contradiction", "no scan"],
)
def test_wrong_settings_are_one_line_that_names_the_file(unmade, tmp_path, content, message):
    path = tmp_path / "mine.yaml"
    path.write_bytes(content)
    *lines, error = snakemake(unmade, "--dry-run", "--configfile", path, fails=True).splitlines()
    assert error.startswith(f"Error in the settings: {path}{message}")
    assert "".join(lines).count("Error") == 0


def test_error_names_a_wrong_setting_on_the_command_line(unmade):
    output = snakemake(unmade, "--dry-run", "--config", "seed=-1", fails=True)
    assert output.splitlines()[-1].startswith("Error in the settings: the settings of --config or of the module: seed:")


def test_error_names_wrong_settings_of_a_module(tmp_path):
    (tmp_path / "Snakefile").write_text(
        f'module viscorough:\n    snakefile: "{ROOT}/Snakefile"\n    config: {{"seed": -1}}\n\n'
        "use rule * from viscorough as rough_*\n"
    )
    output = snakemake(tmp_path, "--dry-run", fails=True)
    assert output.splitlines()[-1].startswith("Error in the settings: the settings of --config or of the module: seed:")


def in_read_only(folder, command):
    """Run a command in a folder that cannot be written; root needs a read-only mount."""
    folder.chmod(0o555)
    if os.access(folder, os.W_OK):
        quoted = shlex.quote(str(folder))
        mount = f"mount --bind {quoted} {quoted} && mount -o remount,bind,ro {quoted} && cd {quoted}"
        if subprocess.run(["unshare", "-m", "sh", "-c", mount], capture_output=True, check=False).returncode:
            pytest.skip("root cannot mount a folder here")
        command = ["unshare", "-m", "sh", "-c", f"{mount} && exec {shlex.join(command)}"]
    variables = environment(folder) | {"PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run(command, cwd=folder, env=variables, capture_output=True, text=True, check=False)


@pytest.mark.long
def test_folder_that_cannot_be_written_is_reported_in_one_line(tmp_path):
    folder, line = copy_project(tmp_path / "copy"), [sys.executable, "-m", "snakemake", "--cores", "1", "--dry-run"]
    done = in_read_only(folder, line)
    assert done.returncode == 1
    assert done.stderr.splitlines()[1:] == [
        f"Error: {folder}: the folder cannot be written; make it writable, or let `snakemake --directory FOLDER` write "
        "all results to another folder"
    ]
    done = in_read_only(folder, [sys.executable, "workflow/run_with_progress.py", "--", *line])
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith(f"Error: {folder}/results/run.log: not written (")
    assert done.stderr.count("\n") == 1
