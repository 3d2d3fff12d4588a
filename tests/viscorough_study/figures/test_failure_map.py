"""Figures of where methods fail."""

import pandas as pd
import pytest

from support.figures import failure_table
from viscorough_study.figures.failure_map import LETTERS, MEANINGS, plot_failure_map
from viscorough_study.robustness.failure_map import VERDICTS

pytestmark = pytest.mark.filterwarnings("error")


def test_map_shows_every_cell_by_number_and_letter():
    table = failure_table(VERDICTS)
    figure = plot_failure_map(table)
    texts = [text.get_text() for text in figure.axes[0].texts]
    cells = [text for text in texts if text.split()[-1] in LETTERS.values()]
    assert len(cells) == len(table)
    assert {"0 H", "1e-3 U", "R"} <= set(cells)
    assert cells.count("R") == 2
    assert set(LETTERS) == set(MEANINGS) == set(VERDICTS)
    assert len(set(LETTERS.values())) == len(LETTERS)


def test_cells_are_blank_where_a_difficulty_cannot_matter():
    rows = [
        ("step size", "16 steps", "path, dense", 1e-9, "holds"),
        ("step size", "16 steps", "events", 1.0, "unnoticed"),
        ("step size", "16 steps", "explicit steps", 0.05, "warned"),
        ("shape", "cone", "path, dense", 2e-9, "holds"),
        ("force in time", "negative", "path, dense", 1.0, "refused"),
    ]
    table = pd.DataFrame(rows, columns=["group", "case", "method", "error", "verdict"])
    texts = [text.get_text() for text in plot_failure_map(table).axes[0].texts]
    assert [text for text in texts if text[-1:] in LETTERS.values()] == ["1 U", "5e-2 W", "2e-9 H", "R"]
