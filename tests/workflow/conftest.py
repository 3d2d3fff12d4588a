"""Projects in which the workflow was run, shared by the tests of the session."""

import os
from types import SimpleNamespace

import pytest

from support.workflow import ROOT, TEST, copy_project, read_settings, snakemake


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """A project after one full run of the small settings. Tests must leave its results complete."""
    folder = copy_project(tmp_path_factory.mktemp("finished"))
    snakemake(folder, *TEST)
    return folder


@pytest.fixture(scope="session")
def fresh(tmp_path_factory):
    """A project in which nothing has been made."""
    return copy_project(tmp_path_factory.mktemp("fresh"))


@pytest.fixture(scope="session")
def common():
    """The functions of common.smk and settings.smk, which are plain Python."""
    names = {"workflow": SimpleNamespace(basedir=str(ROOT))}
    before = dict(os.environ)
    for name in ("common.smk", "settings.smk"):
        exec(compile((ROOT / "workflow/rules" / name).read_text(), name, "exec"), names)
    os.environ.clear()
    os.environ.update(before)
    return SimpleNamespace(**names)


@pytest.fixture
def settings():
    return read_settings("config")
