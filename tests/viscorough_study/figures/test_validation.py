"""Figure of the errors against exact solutions."""

import numpy as np
import pytest

from support.figures import legend_texts, validation_table, whole_on_page
from viscorough_study.figures.validation import plot_validation

pytestmark = pytest.mark.filterwarnings("error")


def test_validation_draws_errors_orders_and_limits():
    figure = plot_validation(validation_table())
    titles = [axes.get_title() for axes in figure.axes]
    assert titles == [name + "\nexpected " + r"$\propto n^{-2}$" for name in ("force", "depth")]
    for axes in figure.axes:
        *cases, limit = axes.lines
        for line, scale in zip(cases, (0.5, 0.7, 0.2), strict=True):
            np.testing.assert_allclose(line.get_xydata(), [(n, scale / n**2) for n in (33, 65, 129)])
        assert len({(line.get_color(), line.get_marker()) for line in cases}) == 3
        assert cases[0].get_color() == cases[1].get_color() != cases[2].get_color()
        assert (limit.get_ydata() == 1e-3).all()
        assert limit.get_xdata()[0] < 129 < limit.get_xdata()[1]
        orders = {text.get_text(): text.get_position()[1] for text in axes.texts}
        assert list(orders) == ["2.0 failed", "2.0"]  # the first of two whose errors differ by less than their labels
        assert orders["2.0 failed"] < orders["2.0"]
        assert axes.get_ylim() == pytest.approx((1e-6, 1e-2))  # whole decades around all that is drawn
    assert legend_texts(figure.legends[0]) == ["sphere", "sphere reduction", "cone", "limit on the finest grid"]
    assert whole_on_page(figure)


@pytest.mark.parametrize("grids", [[33], [17, 33]])
def test_validation_without_orders(grids):
    figure = plot_validation(validation_table(grids, ("force", "stiffness", "area", "punch_stiffness")))
    assert len(figure.axes) == 4
    assert all([text.get_text() for text in axes.texts] == ["failed"] for axes in figure.axes)
    assert whole_on_page(figure)
