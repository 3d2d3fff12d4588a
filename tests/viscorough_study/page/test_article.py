"""The text of the article: no number typed by hand, and results whose characters are no markup of Typst."""

import json
import re

import numpy as np
import pandas as pd
import pytest
import typst
import yaml

from support.documentation import ROOT, read
from viscorough_study.page.article import (
    as_markup,
    bibliography,
    cases_by_outcome,
    citation_key,
    control,
    prefactors,
    small_hurst,
    sources_by_basis,
    sum_rules_shown,
)
from viscorough_study.page.results import Number, Results

SOURCE = read(ROOT / "workflow/article/article.typ.jinja")
LAYOUT = r"chart\(\"\w+\.pdf\"|columns: \([^)]*\)|gutter: \w+|level: \d|#set text\(.*?\)|<[\w-]+>|@[\w-]+"
REFERENCES = r"(?:Eqs?\.|Figures?) \d+(?: (?:to|and) \d+)?"  # references to the paper


def numbers_typed(source):
    """Return the digits in the running text and the decimal numbers in formulas."""
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
    """The values lie at different X, so values at a common X would not be comparable."""
    rows = [(0.6, x, np.nan, 8, g) for x, g in ((0.2, 0.1), (1.1, 0.5), (3.0, 0.2))]
    rows += [(0.6, x, 0.125, 8, g) for x, g in ((0.2, 0.1), (1.1, 0.3), (3.0, 0.4))]
    table = pd.DataFrame(rows, columns=["hurst", "x", "roll_off_wavelength", "surfaces", "g"])
    (row,) = control(Results({"periodic": table}, {}))
    assert (row["hurst"], row["surfaces"]) == (0.6, 8)
    assert [(row[kind]["x"], row[kind]["g"]) for kind in ("whole", "rolled")] == [(1.1, 0.5), (3.0, 0.4)]


def test_sum_rules_are_relative_deviations_without_signs():
    rules = {"first": {"by levels": -0.02, "last level": 1.0}, "second": {"by levels": 0.003}}
    content = {"indenters": {"cone": {"plain": {"1e-03": rules}, "audit": {"1e-05": rules | {"levels": 9}}}}}
    expected = {"first": 0.02, "second": 0.003}
    assert sum_rules_shown(content) == [{"indenter": "cone", "plain": expected, "audit": expected, "levels": 9}]


CASES = pd.DataFrame(
    [
        ("beta", "H = 0.1", 0.2, "reproduced", 0.1),
        ("beta", "H = 0.4", 0.4, "not reproduced", 0.3),
        ("beta", "H = 0.6", 0.5, "undecided", 0.4),
        *[("depth", f"H = 0.{i}", 1 + i / 10, "reproduced under a stated convention", 1.0) for i in range(1, 7)],
    ],
    columns=["claim", "case", "value", "verdict", "expected"],
).assign(low=0.0, high=1.0, conventions=8.0, agreeing=0.0)


def test_passing_and_failing_cases_are_separate():
    shown = cases_by_outcome(Results({"claims": CASES}, {}), "beta")
    cases = {outcome: [case["case"] for case in shown[outcome]["cases"]] for outcome in ("pass", "fail", "undecided")}
    assert cases == {"pass": ["H = 0.1"], "fail": ["H = 0.4"], "undecided": ["H = 0.6"]}
    assert shown["paper"] is None, "each case has its own"
    assert shown["pass"]["cases"][0]["own_value"]


def test_cases_farthest_from_the_paper_are_listed_in_order():
    shown = cases_by_outcome(Results({"claims": CASES}, {}), "depth")
    assert [case["case"] for case in shown["pass"]["cases"]] == ["H = 0.3", "H = 0.4", "H = 0.5", "H = 0.6"]
    assert (shown["pass"]["more"], shown["fail"]["cases"], shown["paper"].value) == (2, [], 1.0)


def test_prefactors_are_listed_between_the_formulas_of_the_paper():
    """At H = 1, β = 1/2 and Γ(3/2) = √π/2: Eq. 4 is π/5, and Eq. 11 without its factor is √π/2."""
    conventions = {"average": "geometric", "rms_convention": "disc", "window_rule": "default"}
    row = {"source": "discs", "case_group": "base", "hurst": 1.0, **conventions, "beta": 0.5, "beta_low": 0.4}
    row |= {"beta_high": 0.6, "zeta": 0.7, "zeta_low": 0.6, "zeta_high": 0.8}
    row |= dict.fromkeys(("zeta_low_with_gamma", "zeta_high_with_gamma"), 0.7)
    scaling = pd.DataFrame([row, row | {"average": "arithmetic", "zeta": 0.9}])
    claims = CASES.assign(claim="zeta_elastic")
    found = prefactors(Results({"scaling": scaling, "claims": claims}, {}), conventions)
    (line,) = found["rows"]
    assert (line["eq_4"], line["eq_11"]) == pytest.approx((np.pi / 5, np.sqrt(np.pi) / 2))
    assert (line["value"], line["least"], line["largest"]) == (0.7, 0.7, 0.9)
    assert found["between"]
    assert (found["conventions"], found["agreeing"]) == (8, 0)
    assert found["radius"] == pytest.approx([np.sqrt(2) * 0.7 / (np.sqrt(np.pi) / 2)] * 2)


def test_departure_at_small_hurst_exponents_has_parts_without_a_value():
    plateaus = pd.DataFrame({"case_group": ["base", "base"], "hurst": [0.4, 0.1], "region_decades": [1.5, 1.2]})
    literature = pd.DataFrame({"quantity": ["alpha"], "hurst": [0.1], "theirs_low": [0.5], "theirs_high": [0.8]})
    claims = CASES.assign(claim=np.where(CASES["claim"] == "beta", "coincide", "other"))
    parts = small_hurst(Results({"plateaus": plateaus, "literature": literature, "claims": claims}, {}))
    assert (parts["hurst"], parts["region"]["region_decades"], parts["own"]["value"].value) == (0.1, 1.2, 0.2)
    assert parts["literature"]["theirs_high"].value == 0.8
    assert parts["equal"] is parts["grid"] is None


def test_every_cited_source_has_a_title_and_is_printed():
    sources = [
        source for source in yaml.safe_load(read(ROOT / "resources/literature/stiffness.yaml")) if "title" in source
    ]
    original = yaml.safe_load(read(ROOT / "CITATION.cff"))["references"][0]
    keys = {citation_key(source) for source in sources}
    assert len(keys) == len(sources) > 5
    assert set(re.findall(r"@([a-z-]+-\d{4})", SOURCE)) == keys, "all are cited where they are used"
    assert {key for members in sources_by_basis(sources).values() for key in members} == keys
    cited = "".join(f"@{key} " for key in ["paper", *sorted(keys)])
    text = f"{cited}\n#bibliography(bytes({json.dumps(bibliography(original, sources), ensure_ascii=False)}))"
    assert typst.compile(text.encode(), format="pdf").startswith(b"%PDF")
    with pytest.raises(typst.TypstError, match="does not exist"):
        typst.compile(f"@nobody-2012 {text}".encode(), format="pdf")
