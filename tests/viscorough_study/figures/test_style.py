"""Common properties of the figures: looks of the Hurst exponents, and complete and reproducible files."""

import numpy as np
import pytest
from matplotlib import colormaps, rc_context
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from PIL import Image

from support.contract import refused
from support.study import SHOWN
from support.workflow import ROOT
from viscorough_study.figures.exponent import plot_exponent
from viscorough_study.figures.style import figure, hurst_looks, save_figure
from viscorough_study.fits.fine_sentence import judged_rows

pytestmark = pytest.mark.filterwarnings("error")


def test_looks_of_a_hurst_exponent_do_not_depend_on_the_list():
    looks = hurst_looks([0.9, 0.1, 0.6, 0.4, 0.9])
    assert list(looks) == [0.1, 0.4, 0.6, 0.9]
    assert all(hurst_looks([alone])[alone] == looks[alone] for alone in looks)
    for name in ("color", "marker", "linestyle"):
        assert len({str(look[name]) for look in looks.values()}) == 4
    grey = [np.dot(to_rgb(look["color"]), (0.3, 0.6, 0.1)) for look in looks.values()]
    assert (np.diff([*grey, 0.77]) > 0.07).all()  # grey levels differ from each other and from the paper's white


@pytest.mark.parametrize(
    ("ends", "label"), [((1e-3, 1e3), "$\\mathdefault{10^{-2}}$"), ((3e3, 6e4), "5000"), ((0.24, 0.27), "0.25")]
)
def test_logarithmic_axes_of_any_range_have_labels(ends, label):
    @figure
    def plot(ends):
        drawn = Figure()
        drawn.subplots().set(xscale="log", xlim=ends)
        return drawn

    (axes,) = plot(ends).axes
    axes.figure.draw_without_rendering()
    assert label in {text.get_text() for text in axes.get_xticklabels()}


def test_matplotlibrc_of_the_user_changes_no_figure(tmp_path):
    """matplotlib reads this file when it is imported; rc_context has the same effect."""

    @figure
    def plot(x):
        drawn = Figure()
        drawn.subplots().plot(x, x)
        return drawn

    save_figure(plot([0, 1]), tmp_path / "a.png")
    with rc_context({"axes.grid": True, "axes.facecolor": "red", "lines.linestyle": ":", "savefig.facecolor": "red"}):
        save_figure(plot([0, 1]), tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_saved_files_are_reproducible(scaling, tmp_path):
    folders = [tmp_path / name for name in "ab"]
    for folder in folders:
        folder.mkdir()
        save_figure(
            drawn := plot_exponent(scaling, SHOWN, (0.4, 1.0), judged_rows(ROOT)),
            folder / "a.png",
            folder / "a.pdf",
        )
        with refused("a.svg: unknown kind of figure; allowed: .png, .pdf"):
            save_figure(drawn, folder / "a.svg")
    first, second = ({path.name: path.read_bytes() for path in folder.iterdir()} for folder in folders)
    assert first == second
    assert set(first) == {"a.png", "a.pdf"}
    with Image.open(folders[0] / "a.png") as picture:
        assert picture.mode == "P", "few colours: all pictures are part of one page"
    assert b"CreationDate" not in first["a.pdf"]
    assert b"/FontFile2" in first["a.pdf"]  # the file embeds TrueType fonts
    assert int.from_bytes(first["a.png"][16:20], "big") == pytest.approx(85 / 25.4 * 200, abs=1)


def test_colour_maps_keep_their_colours(tmp_path):
    """Values read off a colour bar are wrong if the file has fewer colours than the colour map."""
    drawn = Figure()
    drawn.subplots().imshow(np.arange(4096.0).reshape(64, 64), cmap="viridis", interpolation="nearest")
    save_figure(drawn, tmp_path / "map.png")
    with Image.open(tmp_path / "map.png") as picture:
        colours = {color for _, color in picture.convert("RGB").getcolors(2**24)}
    expected = {tuple(color) for color in colormaps["viridis"](np.arange(256), bytes=True)[:, :3].tolist()}
    assert expected <= colours
