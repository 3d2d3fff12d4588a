"""Random files and options keep the contract of the command line; and the judge of it notices what breaks it."""

import fuzz
import fuzz_cases
import numpy as np
import pytest
from file_cases import generators

from support.curves import curve_of_levels


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
    **{name: ["kinetics", name, "--force", "1", "--viscosity", "1"] for name in ("curve.nc", "curve.csv")},
    "line.npy": ["reduce", "line.npy", "--spacing", "1"],
    **{
        name: ["march", "one.npy", "--spacing", "1", "--method", "events", "--force-history", name]
        for name in ("force.csv", "force.npy")
    },
    "medium.yaml": [*KINETICS, "--medium", "medium.yaml"],
    "table.csv": [*KINETICS, "--medium", "of_table.yaml"],
    "record.csv": ["creep", "whole.nc", "record.csv", "--force", "1"],
}


@pytest.mark.parametrize("name", fuzz_cases.FILES)
def test_every_kind_of_file_can_be_right(folder, tmp_path, name):
    """Otherwise the readers would only be tried with what they refuse."""
    curve_of_levels([1e100], [1e100], [1.0], [1]).save(tmp_path / "whole.nc")  # a straight curve, for any force
    others = {
        "one.npy": fuzz_cases.npy_bytes(np.zeros((1, 1))),
        "whole.nc": (tmp_path / "whole.nc").read_bytes(),
        "of_table.yaml": b"{kind: creep_table, file: table.csv}",
    }
    codes = set()
    for _, random in generators(1, range(60)):
        content = fuzz_cases.drawn(random, fuzz_cases.FILES[name])
        output = "out.yaml" if "creep" in COMMANDS[name] else "out.nc"
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
