"""Common properties of the figures: looks of the Hurst exponents, and complete and reproducible files."""

import numpy as np
import pytest
from matplotlib import colormaps, rc_context
from matplotlib.figure import Figure
from PIL import Image

from viscorough_study.figures.style import figure, label_ends, save_figure

pytestmark = pytest.mark.filterwarnings("error")


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


def test_colour_maps_keep_their_colours(tmp_path):
    """Values read off a colour bar are wrong if the file has fewer colours than the colour map."""
    drawn = Figure()
    drawn.subplots().imshow(np.arange(4096.0).reshape(64, 64), cmap="viridis", interpolation="nearest")
    save_figure(drawn, tmp_path / "map.png")
    with Image.open(tmp_path / "map.png") as picture:
        colours = {color for _, color in picture.convert("RGB").getcolors(2**24)}
    expected = {tuple(color) for color in colormaps["viridis"](np.arange(256), bytes=True)[:, :3].tolist()}
    assert expected <= colours


@pytest.mark.parametrize("heights", [[0.5, 0.52, 0.51], [1.0, 1.0, 1.0], [0.0, 0.9, 0.95]])
def test_labels_of_ends_keep_their_order_and_do_not_overlap(heights):
    axes = Figure().subplots()
    axes.set_ylim(0, 1)
    label_ends(axes, [(f"{height}", 1.0, height, "black") for height in heights], gap=0.1)
    shown = np.array([text.xyann[1] for text in axes.texts])
    assert [text.get_text() for text in axes.texts] == [f"{height}" for height in sorted(heights)]
    assert (np.diff(shown) > 0.099).all()
    assert np.abs(shown - sorted(heights)).max() < 0.11
