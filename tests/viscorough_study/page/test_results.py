"""Numbers of the page: their format, and the table cells that they come from."""

import numpy as np
import pandas as pd

from support.page import Page, number_in
from viscorough_study.page.render import begun, caption, number, percent, symbols
from viscorough_study.page.results import Number, Results, read_results
from viscorough_study.run.readable import readable
from viscorough_study.run.tables import write_table


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


def test_results_give_numbers_with_their_table_cells(tmp_path):
    table = pd.DataFrame({"kind": ["a", "b", "a"], "error": [0.3, 0.1, np.nan]})
    columns = {"kind": ("kind", ""), "error": ("error", "1")}
    made_with = {"settings": {"seed": 1}}
    write_table(table, tmp_path / "errors.csv", columns=columns, title="Errors", made_with=made_with)
    results = read_results({"errors": tmp_path / "errors.csv"}, {})
    rows = results.rows("errors", kind="a")
    assert results.extremes(rows, "errors", "error") == 2 * (Number(0.3, "errors", "error", 0),)
    assert results.extremes(results.tables["errors"], "errors", "error")[0] == Number(0.1, "errors", "error", 1)
    assert results.extremes(results.rows("errors", kind="c"), "errors", "error") == (None, None)
    assert results.count("errors", "kind", "a").value == 2
    assert results.settings == {"errors": {"seed": 1}}


def test_captions_become_html_with_the_conventions_of_the_figures():
    text = 'One x & ``make fine-grids``.\n\nMean: {{ snakemake.params.options["conventions"]["average"] }}.'
    html = caption(text, {"average": "geometric"})
    assert html.split("\n")[:2] == ["<p>One x &amp; <code>make fine-grids</code>.</p>", "<p>Mean: geometric.</p>"]


def test_letters_of_quantities_are_set_as_variables_wherever_they_stand_alone():
    html = '<p title="at H">vt/h = X at H = 0.4, 4ηhL; L. Popov&#39;s line is F</p><code>H</code> <math>H</math>'
    wanted = "<var>vt</var>/<var>h</var> = <var>X</var> at <var>H</var> = 0.4, 4<var>ηhL</var>; L. Popov&#39;s line is "
    assert symbols(html) == f'<p title="at H">{wanted}<var>F</var></p><code>H</code> <math>H</math>'
    assert [begun("vt/h is"), begun("the curves")] == ["vt/h is", "The curves"]


def test_docutils_settings_of_the_user_change_no_caption(tmp_path, monkeypatch):
    (tmp_path / "docutils.conf").write_text("[parsers]\nsmart_quotes: yes\n")
    monkeypatch.setenv("DOCUTILSCONFIG", str(tmp_path / "docutils.conf"))
    assert caption('the "disc"', {}) == "<p>the &quot;disc&quot;</p>\n"


def test_numbers_state_the_rule_of_their_table_and_its_script():
    results = Results({"scaling": pd.DataFrame({"beta": [0.4]})}, {}, {"scaling": "fit_scaling"})
    place = "results/tables/scaling.csv, line 3, column beta"
    origin = "rule fit_scaling, workflow/scripts/fit_scaling.py"
    assert results.number("scaling", 0, "beta").attributes["title"] == f"{place}; {origin}"
