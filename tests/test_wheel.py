"""Sdist and wheel contain only the library."""

import tarfile
import zipfile

import distribution

from support.documentation import ROOT

KINDS = (".py", ".pyi", ".csv", ".typed")
LIBRARY = {
    path.relative_to(ROOT / "src").as_posix() for path in (ROOT / "src/viscorough").rglob("*") if path.suffix in KINDS
}


def test_sdist_and_wheel_contain_only_the_library(tmp_path):
    sdist, wheel = distribution.build(tmp_path)
    names = zipfile.ZipFile(wheel).namelist()
    assert {name for name in names if ".dist-info/" not in name} == LIBRARY
    assert {"viscorough/py.typed", "viscorough/__init__.pyi", "viscorough/law/data/calibration.csv"} <= LIBRARY
    assert any(name.endswith("/LICENSE") for name in names)
    assert wheel.stat().st_size <= 1_000_000
    with tarfile.open(sdist) as archive:
        names = {name.split("/src/")[1] for name in archive.getnames() if "/src/" in name}
    assert {name for name in names if name.endswith(KINDS)} == LIBRARY
