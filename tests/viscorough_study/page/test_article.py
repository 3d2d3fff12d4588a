"""The text of the article: no number typed by hand, and results whose signs mean nothing in Typst."""

import json
import re

import numpy as np
import pandas as pd
import typst

from support.documentation import ROOT, read
from support.study import SHOWN
from viscorough_study.page.article import as_markup, control, prefactors, sum_rules_shown
from viscorough_study.page.results import Number, Results

SOURCE = read(ROOT / "workflow/article/article.typ.jinja")
LAYOUT = r"chart\(\"\w+\.pdf\"|columns: \([^)]*\)|gutter: \w+|#set text\(.*?\)|<[\w-]+>|@[\w-]+"
REFERENCES = r"(?:Eqs?\.|Figures?) \d+(?: (?:to|and) \d+)?"  # of the paper


def numbers_typed(source):
    """Digits in the running text and decimal numbers in formulas."""
    text = re.sub(r"\{\{.*?\}\}|\{%.*?%\}", " ", source, flags=re.DOTALL)
    text = re.sub(f"{LAYOUT}|{REFERENCES}", " ", text)
    formulas = re.findall(r"\$[^$]*\$", text)
    words = re.sub(r"\$[^$]*\$", " ", text)
    return re.findall(r"\S*\d\S*", words) + re.findall(r"\d\.\d+|\d{2,}", " ".join(formulas))


def test_no_number_is_typed_by_hand():
    assert numbers_typed(SOURCE) == []
    assert SOURCE.count("{{") > 100


def test_results_are_no_markup():
    assert as_markup(Number(0.123456, "claims", "value", 0)) == "0.123"
    assert as_markup(np.float64(1.2e-5)) == "1.2×10⁻⁵"
    odd = """A* E_x #x $y$ <a> @b [c] `d` ~ // "e" 'f' -- \\ = + -1"""
    shown = typst.query(
        f"#show heading: it => it\n= {as_markup(odd)} <text>".encode(), "<text>", field="body", one=True
    )
    assert "".join(part.get("text", " ") for part in json.loads(shown)["children"]) == odd


def test_control_compares_the_largest_values_with_and_without_a_roll_off():
    """They lie at different X, so that values at one X would not compare like with like."""
    rows = [(0.6, x, np.nan, 8, g) for x, g in ((0.2, 0.1), (1.1, 0.5), (3.0, 0.2))]
    rows += [(0.6, x, 0.125, 8, g) for x, g in ((0.2, 0.1), (1.1, 0.3), (3.0, 0.4))]
    table = pd.DataFrame(rows, columns=["hurst", "x", "roll_off_wavelength", "surfaces", "g"])
    (row,) = control(Results({"periodic": table}, {}))
    assert (row["hurst"], row["surfaces"]) == (0.6, 8)
    assert [(row[kind]["x"], row[kind]["g"]) for kind in ("whole", "rolled")] == [(1.1, 0.5), (3.0, 0.4)]


def test_both_formulas_of_the_paper_stand_beside_the_prefactor_as_one_number():
    table = pd.read_csv(ROOT / "docs/results/scaling.csv")
    rows = pd.DataFrame(prefactors(Results({"scaling": table}, {}), SHOWN)).set_index("hurst")
    assert rows["elastic"].round(2).tolist() == [0.91, 0.82, 0.75, 0.66]
    assert rows["viscous"].round(2).tolist() == [1.81, 1.44, 1.24, 0.97]
    assert ((rows["elastic"] < rows["here"]) & (rows["here"] < rows["viscous"])).all()
    np.testing.assert_allclose(rows["as_radius"].iloc[[0, -1]], [0.84, 1.10], atol=0.01)


def test_sum_rules_are_relative_deviations_without_signs():
    rules = {"first": {"by levels": -0.02, "last level": 1.0}, "second": {"by levels": 0.003}}
    content = {"indenters": {"cone": {"plain": {"1e-03": rules}, "audit": {"1e-05": rules | {"levels": 9}}}}}
    expected = {"first": 0.02, "second": 0.003}
    assert sum_rules_shown(content) == [{"indenter": "cone", "plain": expected, "audit": expected, "levels": 9}]
