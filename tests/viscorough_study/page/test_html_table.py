"""Tables as pages of HTML."""

import re

import numpy as np
import pandas as pd

from support.study import ROOT
from viscorough_study.page.html_table import html_table
from viscorough_study.run.tables import write_table


def test_every_row_and_column_is_shown(tmp_path):
    table = pd.DataFrame({"name": ["a<b", "c & d"], "beta": [1 / 3, np.nan], "count": [12345678, 0]})
    columns = {"name": ("which", None), "beta": ("exponent", "1"), "count": ("how many", "m")}
    files = tmp_path / "fits.csv", tmp_path / "fits.nc"
    write_table(table, *files, columns=columns, dimension="fit", title="Fits <1>")
    page = html_table((ROOT / "workflow/page/table.html.jinja").read_text(), *files)
    rows = [re.findall("<t[hd].*?>(.*?)</t[hd]>", row) for row in re.findall("<tr.*?</tr>", page)]
    assert rows == [list(columns), ["a&lt;b", "0.3333", "12345678"], ["c &amp; d", "", "0"]]
    for text in ("Fits &lt;1&gt;", "2 rows", "fits.csv", "how many [m]", "exponent"):
        assert text in page
    assert "http" not in page, "it opens offline"
