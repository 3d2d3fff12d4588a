"""The wheel: the library alone, and what its metadata say."""

import shutil
import subprocess
import sys
import zipfile
from email import message_from_string

import pytest

from support.documentation import ROOT


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel of a copy of the project, which is left as it is."""
    copy, folder = tmp_path_factory.mktemp("project"), tmp_path_factory.mktemp("wheel")
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, copy)
    shutil.copytree(ROOT / "src", copy / "src", ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
    build = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "--no-index"]
    subprocess.run([*build, "--wheel-dir", folder, copy], check=True)
    with zipfile.ZipFile(*folder.glob("*.whl")) as archive:
        yield archive


def test_it_holds_the_files_of_the_library_and_no_others(wheel):
    held = {name for name in wheel.namelist() if ".dist-info/" not in name}
    kinds = (".py", ".pyi", ".csv", ".typed")
    library = (path for path in (ROOT / "src/viscorough").rglob("*") if path.suffix in kinds)
    assert held == {path.relative_to(ROOT / "src").as_posix() for path in library}
    assert {"viscorough/py.typed", "viscorough/__init__.pyi", "viscorough/data/calibration.csv"} <= held


def test_its_metadata_name_authors_licence_and_paper(wheel):
    (name,) = (name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
    metadata = message_from_string(wheel.read(name).decode())
    assert metadata["Author"] == "The viscorough developers"
    assert metadata["License-Expression"] == "MIT"
    assert "Paper, https://doi.org/10.1103/PhysRevE.87.042802" in metadata.get_all("Project-URL")
    assert "numba>=0.61" in metadata.get_all("Requires-Dist")
    assert any(name.endswith("/LICENSE") for name in wheel.namelist())
