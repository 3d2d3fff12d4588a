"""Numbers of the page: their format, and the table cells that they come from."""

import numpy as np

from support.page import Page, number_in
from viscorough_study.page.render import caption, number, percent
from viscorough_study.page.results import Number
from viscorough_study.run.readable import readable


def test_numbers_are_readable():
    texts = {0.39719: "0.397", -0.1021: "−0.102", 51433.0: "51433", 2013.4: "2013", 1.318e-5: "1.3×10⁻⁵"}
    texts |= {2e-6: "2×10⁻⁶", 0.0: "0", np.inf: "∞", None: "–", np.nan: "–"}
    assert {value: readable(value) for value in texts} == texts
    assert [readable(value, power=True) for value in (1e5, 3e6)] == ["1×10⁵", "3×10⁶"]
    for value in list(texts)[:7]:
        number, half_a_digit = number_in(readable(value))
        assert abs(number - value) <= half_a_digit * 1.001


def test_numbers_name_their_table_cell():
    html = str(number(Number(0.123456, "claims", "value", 7)))
    html += str(number(Number(3, "claims", "verdict", counted="not <b>")))
    (_, place, text), (_, count, counted) = Page(html).numbers
    wanted = {"value": "0.123456", "data-table": "claims", "data-row": "7", "data-column": "value"}
    assert place == wanted | {"title": "results/tables/claims.csv, line 10, column value"}
    assert (text, counted) == ("0.123", "3")
    assert count["data-counted"] == "not <b>"
    assert str(percent(Number(0.0131, "methods", "error", 0))).endswith(">1.31 %</data>")
    assert number(None) == number(Number(np.nan, "claims", "value", 0)) == "–"


def test_docutils_settings_of_the_user_change_no_caption(tmp_path, monkeypatch):
    (tmp_path / "docutils.conf").write_text("[parsers]\nsmart_quotes: yes\n")
    monkeypatch.setenv("DOCUTILSCONFIG", str(tmp_path / "docutils.conf"))
    assert caption('the "disc"', {})[0] == "<p>the &quot;disc&quot;</p>\n"
