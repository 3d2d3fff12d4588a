"""Projects in which the workflow is run, made once for all processes of a test session; every test gets a copy."""

import shutil

import pytest

from support.workflow import TEST, copy_project, made_once, snakemake


@pytest.fixture
def finished(tmp_path_factory, tmp_path):
    """A project after one full run of the small settings."""

    def make(folder):
        copy_project(folder)
        snakemake(folder, *TEST)

    return shutil.copytree(made_once(tmp_path_factory, "finished", make), tmp_path / "finished")


@pytest.fixture(scope="session")
def unmade(tmp_path_factory):
    """A project in which nothing has been made. Tests must not make anything."""
    return copy_project(tmp_path_factory.mktemp("unmade"))
