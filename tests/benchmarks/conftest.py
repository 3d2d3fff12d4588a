"""A stand-in for ASPHER, shared by the tests of the races with other solvers."""

import os

import pytest

from support.workflow import ROOT


@pytest.fixture
def aspher(tmp_path, monkeypatch):
    """The stand-in on the path of other processes, with its version."""
    metadata = tmp_path / "aspher-4.5.dist-info/METADATA"
    metadata.parent.mkdir()
    metadata.write_text("Metadata-Version: 2.1\nName: aspher\nVersion: 4.5\n")
    paths = (tmp_path, ROOT / "tests/support", ROOT / "tests/support/other_solvers")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(map(str, paths)))
