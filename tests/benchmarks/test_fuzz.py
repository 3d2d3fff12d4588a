"""Random files and options keep the contract of the command line, and the fuzzer notices every breach of it."""

import fuzz
import fuzz_cases
import pytest
from measuring import generators

pytestmark = [pytest.mark.long, pytest.mark.filterwarnings("default")]


@pytest.fixture(scope="session")
def loaded():
    fuzz.load()


@pytest.mark.usefixtures("loaded")
def test_random_files_and_options_keep_the_contract(monkeypatch):
    """Repeat a breach with `python benchmarks/fuzz.py --seed 2013 --only NUMBER`. One file opens too slowly."""
    monkeypatch.setattr("viscorough.cli.files.LONGEST", 5)
    breaches, codes = fuzz.breaches(2013, range(40))
    assert breaches == []
    assert codes["0"] > 3
    assert codes["2"] > 15


@pytest.mark.usefixtures("loaded")
@pytest.mark.parametrize("line", fuzz_cases.COMMAND_LINES)
def test_every_kind_of_command_line_can_be_valid(line):
    """Otherwise the readers would only see input that they refuse."""
    for _, random in generators(1, range(60)):
        arguments = fuzz_cases.valid_arguments(random, line)
        code, words = fuzz.result_of(arguments, fuzz_cases.files_of(random, arguments, faults=0))
        assert not words
        if code == 0:
            return
    pytest.fail("always refused")


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
