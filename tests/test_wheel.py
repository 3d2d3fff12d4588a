"""Sdist and wheel contain only the library."""

import shutil
import subprocess
import sys
import tarfile
import zipfile

from support.documentation import ROOT

KINDS = (".py", ".pyi", ".csv", ".typed")
LIBRARY = {
    path.relative_to(ROOT / "src").as_posix() for path in (ROOT / "src/viscorough").rglob("*") if path.suffix in KINDS
}


BUILD_SDIST = "import sys, setuptools.build_meta as backend; backend.build_sdist(sys.argv[1])"


def build(folder):
    """Build sdist and wheel from a copy of the sources without files of earlier builds; return their paths."""
    copy = folder / "copy"
    shutil.copytree(ROOT / "src", copy / "src", ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, copy)
    subprocess.run([sys.executable, "-c", BUILD_SDIST, folder], cwd=copy, check=True, capture_output=True)
    (sdist,) = folder.glob("*.tar.gz")
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "--no-index"]
    subprocess.run([*command, "--wheel-dir", folder, sdist], check=True)
    (wheel,) = folder.glob("*.whl")
    return sdist, wheel


def test_sdist_and_wheel_contain_only_the_library(tmp_path):
    sdist, wheel = build(tmp_path)
    names = zipfile.ZipFile(wheel).namelist()
    assert {name for name in names if ".dist-info/" not in name} == LIBRARY
    assert {"viscorough/py.typed", "viscorough/__init__.pyi", "viscorough/law/data/calibration.csv"} <= LIBRARY
    assert any(name.endswith("/LICENSE") for name in names)
    assert wheel.stat().st_size <= 1_000_000
    with tarfile.open(sdist) as archive:
        names = {name.split("/src/")[1] for name in archive.getnames() if "/src/" in name}
    assert {name for name in names if name.endswith(KINDS)} == LIBRARY
