"""Random changes of the sources: how they are drawn, and how the campaign decides that one is caught."""

import ast
import shutil
from collections import Counter

import mutants as campaign
import pytest

pytestmark = pytest.mark.long

SOURCE = """\
def half(x: int | None) -> float | None:
    return x / 2
"""
TEST = """\
from half import half

def test_half():
    assert half(4) == 2
"""


@pytest.fixture(scope="module")
def texts():
    """Return one longer and five shorter sources: drawing takes less time, and most changes must be in the longer."""
    texts = campaign.sources()
    by_lines = sorted((campaign.code_lines(text), name) for name, text in texts.items())
    short, long = (next(i for i, (lines, _) in enumerate(by_lines) if lines >= least) for least in (15, 90))
    return {name: texts[name] for _, name in [*by_lines[short : short + 5], by_lines[long]]}


def test_mutants_are_single_changes_in_proportion_to_the_lines(texts):
    mutants = list(campaign.drawn(texts, 3, range(60)))
    for mutant in mutants:
        ast.parse(mutant.text)
        assert mutant.text != texts[mutant.file]
        lines = campaign.difference(mutant, texts[mutant.file])
        assert {line[0] for line in lines} == {"-", "+"}
        assert lines[0][1:] in texts[mutant.file].splitlines()[mutant.line - 2 : mutant.line + 1]
    (again,) = campaign.drawn(texts, 3, [41])  # independent of the draws before
    assert again == mutants[41]
    assert list(campaign.drawn(texts, 4, range(5))) != mutants[:5]
    longest = max(texts, key=lambda name: campaign.code_lines(texts[name]))
    share = campaign.code_lines(texts[longest]) / sum(map(campaign.code_lines, texts.values()))
    assert abs(Counter(mutant.file for mutant in mutants)[longest] / 60 - share) < 4 * (share * (1 - share) / 60) ** 0.5
    assert share > 0.5


def test_annotations_and_changes_without_effect_are_left_out():
    changes = campaign.places(SOURCE + "\n@njit(nogil=True)\ndef f(x):\n    return x is None\n")
    assert {line for _, line, _ in changes} == {2, 6}
    names = {name for choices in changes.values() for name, _ in choices}
    assert "core/ReplaceBinaryOperator_Div_Mul" in names
    assert not names & {"core/ReplaceBinaryOperator_Div_BitOr", "core/ReplaceComparisonOperator_Is_Eq"}


def test_every_source_has_tests():
    for file in (name for name, text in campaign.sources().items() if campaign.code_lines(text)):
        tests, further = campaign.area_tests(file), campaign.further_tests(file)
        assert tests, file
        assert all((campaign.ROOT / test).is_file() for test in tests + further)
        assert not set(tests) & set(further)
    further = campaign.further_tests("src/viscorough/contact/prescribed_depth.py")
    assert {"tests/viscorough/contact/test_one_contact.py", "tests/benchmarks/test_random_curves.py"} <= set(further)
    assert "tests/viscorough_study/ensembles/test_indentation.py" in campaign.area_tests(
        "workflow/scripts/reduce_lines.py"
    )


def test_a_mutant_is_caught_survives_or_is_undecided(tmp_path, monkeypatch):
    """The project has one module and one test."""
    clean, file = tmp_path / "clean", "src/half.py"
    odd = TEST.replace("half(4) == 2", "half(5) == 2.5")
    for name, text in {file: SOURCE, "workflow/test_half.py": TEST, "workflow/test_odd.py": odd}.items():
        (clean / name).parent.mkdir(parents=True, exist_ok=True)
        (clean / name).write_text(text)
    monkeypatch.setenv("PYTEST_ADDOPTS", "--rootdir .")
    shutil.copytree(clean, tmp_path / "core0")

    def verdict(old, new, stages=(["workflow/test_half.py"],), time_limit=60):
        mutant = campaign.Mutant(0, file, 2, "", SOURCE.replace(old, new))
        result = campaign.outcome(mutant, clean, tmp_path / "core0", {file: SOURCE}, [[], *stages], time_limit)
        assert result["difference"] == ["-    return x / 2", f"+    return {new}"]
        return result["verdict"]

    assert verdict("x / 2", "x / 3") == campaign.CAUGHT
    assert verdict("x / 2", "x / 2.0") == campaign.SURVIVED
    assert verdict("x / 2", "x // 2", stages=[["workflow/test_half.py"], ["workflow/test_odd.py"]]) == campaign.CAUGHT
    assert verdict("x / 2", "__import__('os').abort()") == campaign.CRASHED
    assert verdict("x / 2", "x / 3", stages=[["absent.py"]]) == campaign.BROKEN
    assert verdict("x / 2", "__import__('time').sleep(1e3)", time_limit=5) == campaign.ENDED
    assert (clean / file).read_text() == SOURCE
