"""Figure of the kinetics in other media."""

import numpy as np
import pytest

from support.figures import coordinates, legend_texts, media_table, whole_on_page
from viscorough_study.figures.media import plot_media
from viscorough_study.figures.media_exponents import plot_media_exponents
from viscorough_study.medium_names import medium_label


def test_velocity_in_every_medium_and_depth_in_all():
    table = media_table()
    figure = plot_media(table)
    newtonian, solid, all_media = figure.axes
    assert [axes.get_title() for axes in figure.axes] == ["Newtonian", "Standard linear solid", "all media"]
    for axes, medium in ((newtonian, "newtonian"), (solid, "standard_linear_solid")):
        for hurst, line in zip((0.4, 0.9), coordinates(axes), strict=False):
            rows = table[(table["medium"] == medium) & (table["hurst"] == hurst)]
            np.testing.assert_array_equal(line, rows[["time", "velocity"]])
    assert len(all_media.lines) == 4
    np.testing.assert_array_equal(all_media.lines[0].get_xydata(), table[["x", "depth"]][:13])
    assert legend_texts(all_media.get_legend()) == ["Newtonian", "Standard linear solid"]
    assert figure.legends[0].get_title().get_text() == "each a mean over 6 discs"
    assert whole_on_page(figure)
    with pytest.raises(ValueError, match="plot_media: the table has no rows"):
        plot_media(table[:0])


def test_guides_have_the_slopes_of_the_caption():
    axes = plot_media(media_table()).axes[0]
    for style, slopes in ((":", (1, 1)), ("--", (0.4 / 1.4, 0.9 / 1.9))):
        guides = [
            np.log(line.get_xydata())
            for line in axes.lines
            if line.get_linestyle() == style and line.get_linewidth() == 0.6
        ]
        for guide, slope in zip(guides, slopes, strict=True):
            rise = guide[-1] - guide[0]
            assert rise[1] / rise[0] == pytest.approx(slope)


def test_exponents_in_every_medium():
    table = media_table()
    figure = plot_media_exponents(table)
    assert [axes.get_title() for axes in figure.axes] == ["Newtonian", "Standard linear solid"]
    for axes, medium in zip(figure.axes, ("newtonian", "standard_linear_solid"), strict=True):
        for hurst, lines in zip((0.4, 0.9), (coordinates(axes)[:2], coordinates(axes)[2:4]), strict=True):
            rows = table[(table["medium"] == medium) & (table["hurst"] == hurst)]
            for line, name in zip(lines, ("exponent", "expected"), strict=True):
                np.testing.assert_array_equal(line, rows[["time", name]])
    assert whole_on_page(figure)
    with pytest.raises(ValueError, match="plot_media_exponents: the table has no rows"):
        plot_media_exponents(table[:0])


def test_names_of_media_are_words():
    assert medium_label("kelvin_voigt") == "Kelvin-Voigt"
    assert medium_label("standard_linear_solid") == "Standard linear solid"
