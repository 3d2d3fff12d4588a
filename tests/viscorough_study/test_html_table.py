"""Tables as pages of HTML."""

from html.parser import HTMLParser

import numpy as np
import pandas as pd

from support.study import ROOT
from viscorough_study.html_table import html_table
from viscorough_study.tables import write_table


class Cells(HTMLParser):
    """The texts of the cells of every row, and of the whole page; fails on tags that are not closed."""

    def __init__(self, page):
        super().__init__()
        self.open, self.rows, self.text = [], [], ""
        self.feed(page)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        if tag != "meta":
            self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        if tag in ("th", "td"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data
        if self.open and self.open[-1] in ("th", "td"):
            self.rows[-1][-1] += data


def page_of(table, columns, folder, title="Fits"):
    files = folder / "fits.csv", folder / "fits.nc"
    write_table(table, *files, columns=columns, dimension="fit", title=title)
    return html_table((ROOT / "workflow/page/table.html.jinja").read_text(), *files)


def test_every_row_and_column_is_shown(tmp_path):
    table = pd.DataFrame(
        {"name": ["a<b", "c & d"], "beta": [1 / 3, np.nan], "count": [12345678, 0], "passed": [True, False]}
    )
    columns = {
        "name": ("which one", None),
        "beta": ("exponent", "1"),
        "count": ("how many", "m"),
        "passed": ("yes?", "1"),
    }
    page = page_of(table, columns, tmp_path, "Fits <1>")
    cells = Cells(page)
    assert cells.rows == [list(columns), ["a<b", "0.3333", "12345678", "yes"], ["c & d", "", "0", "no"]]
    for text in ("Fits <1>", "2 rows", "fits.csv", "how many [m]", "exponent\n"):
        assert text in cells.text
    assert "http" not in page, "it opens offline"


def test_table_without_rows(tmp_path):
    page = page_of(pd.DataFrame({"beta": []}), {"beta": ("exponent", "1")}, tmp_path)
    assert Cells(page).rows == [["beta"]]
