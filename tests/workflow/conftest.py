"""Projects to run the workflow in, made once for all processes of a test session; every test gets a copy."""

import shutil

import pytest

from support.workflow import STARTED, TEST, common_folder, copy_project, made_once, snakemake


@pytest.fixture(scope="session", autouse=True)
def started_scripts(tmp_path_factory):
    """Let each script run in a new process once in the session, with its first job."""
    folder = common_folder(tmp_path_factory) / "started"
    folder.mkdir(exist_ok=True)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(STARTED, str(folder))
        yield


@pytest.fixture(scope="session")
def finished_once(tmp_path_factory):
    """Make a project with one full run of the small settings, whose output is run.log. Tests must not change it."""

    def make(folder):
        copy_project(folder)
        (folder / "run.log").write_text(snakemake(folder, *TEST))

    return made_once(tmp_path_factory, "finished", make)


@pytest.fixture
def finished(finished_once, tmp_path):
    """Copy the finished project, so that the test may change the copy."""
    return shutil.copytree(finished_once, tmp_path / "finished")


@pytest.fixture(scope="session")
def unmade(tmp_path_factory):
    """Make a project without results. Tests must not make any in it."""
    return copy_project(tmp_path_factory.mktemp("unmade"))
