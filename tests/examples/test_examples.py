"""Every script in examples/ is short, makes its figure, and finds the number that stands here."""

import runpy

import matplotlib as mpl
import pytest
from matplotlib.testing.compare import compare_images

from support.documentation import ROOT, read

FOLDER = ROOT / "examples"
# {script: (name of a number in it, its value, relative tolerance)}
NUMBERS = {
    "contact_map": ("fraction", 0.12055, 0.01),
    "patches": ("numbers", [115, 362, 771, 510], 0.03),
    "contact_area": ("ratio", 1.5244, 0.01),
    "ramp": ("depth", 2.1061, 2e-3),
    "reduction": ("ratio", 0.9732, 0.01),
    "ramp_in_a_polymer": ("crept", 2.1317, 5e-3),
}


@pytest.fixture(autouse=True)
def in_a_new_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    mpl.use("agg")


def run(name):
    names = runpy.run_path(str(FOLDER / f"{name}.py"))
    mpl.pyplot.close("all")
    return names


@pytest.mark.parametrize("name", NUMBERS)
def test_examples_find_their_number_and_make_their_figure(tmp_path, name):
    what, value, tolerance = NUMBERS[name]
    assert run(name)[what] == pytest.approx(value, rel=tolerance)
    assert compare_images(ROOT / f"docs/examples/{name}.png", tmp_path / f"{name}.png", tol=5) is None


def test_a_sphere_in_a_solid_follows_lee_and_radok(tmp_path):
    assert run("sphere_in_a_solid")["error"] < 2e-4
    assert (
        compare_images(ROOT / "docs/examples/sphere_in_a_solid.png", tmp_path / "sphere_in_a_solid.png", tol=5) is None
    )


def test_examples_are_short_and_on_the_page_with_a_small_figure():
    page, names = read(ROOT / "docs/examples.md"), {path.stem for path in FOLDER.glob("*.py")}
    assert names == {*NUMBERS, "sphere_in_a_solid", "own_surface"}
    for name in names - {"own_surface"}:
        assert len(read(FOLDER / f"{name}.py").splitlines()) <= 40
        assert f"(examples/{name}.png)" in page
        assert f"`examples/{name}.py`" in page
        assert (ROOT / f"docs/examples/{name}.png").stat().st_size <= 40_000
