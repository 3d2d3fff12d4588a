"""The faults that are planted fit the sources; a fault that is not caught is counted."""

import planted_faults as planted


def test_every_fault_can_be_planted_and_has_its_tests():
    assert [line for fault in planted.read_faults() for line in planted.problems(fault)] == []


def test_a_fault_is_caught_missed_or_undecided(tmp_path, monkeypatch):
    """A fault in a project of one module and one test."""
    (tmp_path / "clean").mkdir()
    (tmp_path / "clean/half.py").write_text("def half(x):\n    return x / 2\n")
    (tmp_path / "clean/test_half.py").write_text("from half import half\n\ndef test_half():\n    assert half(4) == 2\n")
    fault = planted.Fault("half", "half.py", "x / 2", "x / 3", ("test_half.py::test_half",), "halves are thirds")
    monkeypatch.setenv("PYTEST_ADDOPTS", "--rootdir .")
    for changes, verdict in (
        ({}, "caught"),
        ({"new": "x / 2.0"}, "missed"),
        ({"tests": ("absent.py",)}, "tests did not run"),
    ):
        outcome = planted.outcome(fault._replace(**changes), tmp_path / "clean", tmp_path / "planted")
        assert outcome["verdict"] == verdict
    assert (tmp_path / "clean/half.py").read_text() == "def half(x):\n    return x / 2\n"
    assert not (tmp_path / "planted").exists()
