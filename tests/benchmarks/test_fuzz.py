"""Random files and options keep the contract of the command line; and the judge of it notices what breaks it."""

import os
import signal
import time

import fuzz
import fuzz_cases
import numpy as np
import pytest
from file_cases import generators

from viscorough.io import netcdf
from viscorough.io.curves import curve_to_content
from viscorough.loading_curve import LoadingCurve


@pytest.fixture(scope="module")
def folder():
    with fuzz.workplace() as folder:
        yield folder


def test_random_files_and_options_keep_the_contract(folder, monkeypatch):
    """A breach is repeated by `python benchmarks/fuzz.py --seed 2013 --only NUMBER`; one file opens too slowly."""
    monkeypatch.setattr("viscorough.cli.files.LONGEST", 5)
    breaches, codes = fuzz.breaches(2013, range(40), folder)
    assert breaches == []
    assert codes["0"] > 3
    assert codes["2"] > 15


KINETICS = ["kinetics", "whole.nc", "--force", "1", "--times", "0.5"]
COMMANDS = {
    **{f"heights.{kind}": ["indent", f"heights.{kind}", "--spacing", "1"] for kind in ("npy", "txt", "csv", "tif")},
    **{f"heights.{kind}": ["indent", f"heights.{kind}"] for kind in ("xyz", "nc", "asc")},  # which state it
    **{name: ["plot", name] for name in ("curve.nc", "curve.csv")},
    "line.npy": ["reduce", "line.npy", "--spacing", "1"],
    **{
        name: ["march", "one.npy", "--spacing", "1", "--method", "events", "--force-history", name]
        for name in ("force.csv", "force.npy")
    },
    "medium.yaml": [*KINETICS, "--medium", "medium.yaml"],
    "table.csv": [*KINETICS, "--medium", "of_table.yaml"],
}


@pytest.mark.parametrize("name", fuzz_cases.FILES)
def test_every_kind_of_file_can_be_right(folder, tmp_path, name):
    """Otherwise the readers would only be tried with what they refuse."""
    one_level = [np.array([value]) for value in (1e100, 1e100, 1.0, 1)]  # a straight curve, for any force
    curve = LoadingCurve(*one_level, 1, "by hand", 1e-9, 0, np.zeros(1))
    netcdf.write(curve_to_content(curve), tmp_path / "whole.nc")
    output = "out.png" if COMMANDS[name][0] == "plot" else "out.nc"
    others = {
        "one.npy": fuzz_cases.npy_bytes(np.zeros((1, 1))),
        "whole.nc": (tmp_path / "whole.nc").read_bytes(),
        "of_table.yaml": b"{kind: creep_table, file: table.csv}",
    }
    codes = set()
    for _, random in generators(1, range(60)):
        content = fuzz_cases.drawn(random, fuzz_cases.FILES[name])
        code, words = fuzz.result_of(folder, [*COMMANDS[name], "-o", output], others | {name: content})
        assert not words
        codes.add(code)
        if codes >= {0, 2}:
            return
    pytest.fail(f"exit codes {codes}")


@pytest.mark.parametrize(
    ("result", "changed", "what"),
    [
        ((2, "", "viscorough indent: wrong\n"), [], ""),
        ((2, "", "viscorough indent: wrong\n"), ["out.nc"], "exit code 2, but out.nc changed"),
        ((2, "", "two\nlines\n"), [], "2 lines on stderr"),
        ((2, "out", "viscorough indent: wrong\n"), [], "stdout 'out'"),
        ((-11, "", ""), [], "exit code -11"),
        ((0, "", ""), [], "0 files changed"),
        ((0, "", "Traceback\n"), ["out.nc"], "other than warnings"),
        ((0, "", ""), ["code-was-run"], "code in a file was run"),
    ],
)
def test_breaches_of_the_contract_are_noticed(tmp_path, result, changed, what):
    words = fuzz.breach(["indent"], result, {}, {tmp_path / name: b"" for name in changed})
    assert what in words
    assert bool(words) == bool(what)


@pytest.mark.parametrize(
    ("name", "values", "what"),
    [
        ("depth", [1.0, 2.0], ""),
        ("depth", [1.0, np.nan], "the output has depth"),
        ("time", [2.0, 1.0], "time does not increase"),
        ("depth", [], "the output has depth"),
    ],
)
def test_faults_of_outputs_are_noticed(tmp_path, name, values, what):
    variable = netcdf.Variable(("level",), np.array(values), {"long_name": name, "units": "m"})
    netcdf.write(netcdf.Content({name: variable}, {}), tmp_path / "out.nc")
    assert fuzz.fault_of_output(tmp_path / "out.nc").startswith(what)
    assert bool(fuzz.fault_of_output(tmp_path / "out.nc")) == bool(what)
    (tmp_path / "half.nc").write_bytes((tmp_path / "out.nc").read_bytes()[:100])
    assert "cannot be read" in fuzz.fault_of_output(tmp_path / "half.nc")


def test_code_in_a_file_would_be_run_by_a_careless_reader(folder):
    (folder / "heights.npy").write_bytes(fuzz_cases.PICKLED)
    np.load(folder / "heights.npy", allow_pickle=True)
    assert (folder / fuzz_cases.STARTED).exists()


@pytest.mark.parametrize("end", ["killed", "exception", "endless"])
def test_ended_processes_exceptions_and_runs_without_end_are_noticed(folder, monkeypatch, end):
    def main(_):
        if end == "killed":
            os.kill(os.getpid(), signal.SIGTERM)
        if end == "endless":
            time.sleep(60)
        raise ZeroDivisionError

    monkeypatch.setattr(fuzz.cli, "main", main)
    monkeypatch.setattr(fuzz, "LONGEST", 0.2 if end == "endless" else 60)
    code, words = fuzz.result_of(folder, ["indent"], {})
    assert code == {"killed": -signal.SIGTERM, "exception": 1, "endless": -signal.SIGKILL}[end]
    assert ("lines on stderr: 'Traceback" if end == "exception" else f"exit code {code}") in words
