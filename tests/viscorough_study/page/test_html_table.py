"""Tables as pages of HTML."""

import re

import numpy as np
import pandas as pd

from support.study import ROOT
from viscorough_study.page.html_table import html_table
from viscorough_study.run.tables import write_table


def cells(page):
    """The texts of the cells of every row."""
    rows = re.findall("<tr.*?</tr>", page, re.DOTALL)
    return [[re.sub("<.*?>", "", cell) for cell in re.findall("<t[hd].*?</t[hd]>", row, re.DOTALL)] for row in rows]


def page_of(table, columns, folder, title="Fits"):
    files = folder / "fits.csv", folder / "fits.nc"
    write_table(table, *files, columns=columns, dimension="fit", title=title)
    return html_table((ROOT / "workflow/page/table.html.jinja").read_text(), *files)


def test_every_row_and_column_is_shown(tmp_path):
    table = pd.DataFrame({"name": ["a<b", "c & d"], "beta": [1 / 3, np.nan], "count": [12345678, 0]})
    columns = {"name": ("which", None), "beta": ("exponent", "1"), "count": ("how many", "m")}
    page = page_of(table, columns, tmp_path, "Fits <1>")
    rows = [["a&lt;b", "0.3333", "12345678"], ["c &amp; d", "", "0"]]
    assert [[cell.strip() for cell in row] for row in cells(page)] == [list(columns), *rows]
    for text in ("Fits &lt;1&gt;", "2 rows", "fits.csv", "how many [m]", "exponent"):
        assert text in page
    assert "http" not in page, "it opens offline"
    assert cells(page_of(table[["beta"]][:0], {"beta": ("exponent", "1")}, tmp_path)) == [["beta"]]
