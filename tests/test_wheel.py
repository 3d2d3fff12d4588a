"""Sdist and wheel: the library alone."""

import tarfile
import zipfile

import distribution
import pytest

from support.documentation import ROOT

KINDS = (".py", ".pyi", ".csv", ".typed")
LIBRARY = {
    path.relative_to(ROOT / "src").as_posix() for path in (ROOT / "src/viscorough").rglob("*") if path.suffix in KINDS
}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return distribution.build(tmp_path_factory.mktemp("dist"))


def test_the_wheel_holds_the_files_of_the_library_and_no_others(built):
    names = zipfile.ZipFile(built[1]).namelist()
    assert {name for name in names if ".dist-info/" not in name} == LIBRARY
    assert {"viscorough/py.typed", "viscorough/__init__.pyi", "viscorough/data/calibration.csv"} <= LIBRARY
    assert any(name.endswith("/LICENSE") for name in names)
    assert built[1].stat().st_size <= 1_000_000


def test_the_sdist_has_no_study(built):
    with tarfile.open(built[0]) as archive:
        names = {name.split("/src/")[1] for name in archive.getnames() if "/src/" in name}
    assert {name for name in names if name.endswith(KINDS)} == LIBRARY


def test_what_runs_from_the_wheel():
    """README's lines and all examples, without the checkout's own folders."""
    scripts = distribution.scripts()
    assert set(scripts) == {"README", *(path.stem for path in (ROOT / "examples").glob("*.py"))}
    assert all("savefig" in text for text in scripts.values())
