"""Every script in examples/ makes its figure and finds the number recorded here."""

import runpy

import matplotlib as mpl
import pytest
from matplotlib.testing.compare import compare_images

from support.documentation import ROOT

FOLDER = ROOT / "examples"
# {script: (name of a number in it, its value)}
NUMBERS = {
    "contact_map": ("fraction", pytest.approx(0.12055, rel=0.01)),
    "patches": ("numbers", pytest.approx([115, 362, 771, 510], rel=0.03)),
    "contact_area": ("ratio", pytest.approx(1.5244, rel=0.01)),
    "ramp_in_a_polymer": ("crept", pytest.approx(2.1317, rel=5e-3)),
    "force_curve": ("works", pytest.approx([8.147e-17, 3.4348e-16, 1.8556e-16], rel=0.01)),
    "sphere_in_a_solid": ("error", pytest.approx(0, abs=2e-4)),
}


@pytest.fixture(autouse=True)
def in_a_new_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("name", NUMBERS)
def test_examples_find_their_number_and_make_their_figure(tmp_path, name):
    names = runpy.run_path(str(FOLDER / f"{name}.py"))
    mpl.pyplot.close("all")
    number, value = NUMBERS[name]
    assert names[number] == value
    assert compare_images(ROOT / f"docs/examples/{name}.png", tmp_path / f"{name}.png", tol=5) is None


def test_every_example_is_tested():
    assert {path.stem for path in FOLDER.glob("*.py")} == {*NUMBERS}
