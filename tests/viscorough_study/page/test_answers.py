"""The answers at the top of the page: every sentence uses numbers of the claims whose verdicts it shows."""

import re

import pandas as pd
import pytest

from support.study import CLAIMS, ROOT
from viscorough_study.page.answers import answers
from viscorough_study.page.render import render
from viscorough_study.page.results import Results

TABLE = pd.read_csv(ROOT / "docs/claims.csv")
FOUND = answers(Results({"claims": TABLE}, {}))
# {claim: claim beyond the paper whose numbers follow in the same sentence}
FOLLOWING = {"power_law": "power_law_control", "beta_lines": "exponent_small_hurst"}


def text_of(found, claims):
    """Return the list of answers with <claim> for a claim's verdict and {row column} for a number."""
    template = (ROOT / "workflow/page/page.html.jinja").read_text(encoding="utf-8")
    findings = re.search("({% set a = answers %}.*?)</section>", template, re.DOTALL)[1]
    plain = "{% macro finding(name, heading, marks) %}{{ marks }} {{ caller() }}{% endmacro %}"
    answer = template.split("{% macro picture")[0] + plain + findings
    marks = {name: f"<{name}>" for name in claims}
    shown = {
        "overall": marks,
        "case_counts": dict.fromkeys(marks, ""),
        "verdict_short": dict.fromkeys(marks.values(), ""),
    }
    html = render(answer, "", {}, {}, conventions={}, answers=found, **shown)
    html = re.sub(r'<data [^>]*data-row="(\d+)" data-column="(\w+)"[^>]*>[^<]*</data>', r"{\1 \2}", html)
    return " ".join(re.sub("<.*?>", "", html).split()).replace("&lt;", "<").replace("&gt;", ">")


@pytest.fixture(scope="module")
def text():
    return text_of(FOUND, CLAIMS)


@pytest.mark.parametrize(
    "claim", ["beta", "beta_lines", "coincide", "exponent_small_hurst", "power_law", "one_constant"]
)
def test_claims_without_a_case_leave_a_complete_page(claim):
    """A run may have only small or only large Hurst exponents."""
    found = answers(Results({"claims": TABLE[TABLE["claim"] != claim]}, {}))
    page = text_of(found, set(CLAIMS) - {claim})
    assert claim == "exponent_small_hurst" or "no case in this run" in page


def test_numbers_belong_to_the_claims_named_before_them(text):
    parts = re.findall(r"((?:<\w+>[^{<]*)+)((?:\{\d+ \w+\}[^{<]*)+)", text)
    for verdicts, numbers in parts:
        rows, named = [int(row) for row in re.findall(r"\{(\d+)", numbers)], set(re.findall(r"<(\w+)>", verdicts))
        named -= {"zeta_better"}  # a comparison without a number of its own
        assert set(TABLE.loc[rows, "claim"]) - {FOLLOWING.get(name) for name in named} == named
    assert sum(numbers.count("{") for _, numbers in parts) == text.count("{")


def test_verdicts_on_an_equation_belong_to_its_claims(text):
    named = re.findall(r"(Eq\. \d+)(?:, with Γ)?: <(\w+)>", text)
    assert [CLAIMS[claim]["where"] for _, claim in named] == [equation for equation, _ in named] == ["Eq. 4", "Eq. 11"]


def test_intervals_and_cases_belong_to_their_numbers(text):
    intervals = re.findall(r"\{(\d+) value\} \[\{(\d+) low\}, \{(\d+) high\}\]", text)
    assert all(len(set(rows)) == 1 for rows in intervals)
    assert len(intervals) == text.count("[") > 2
    cases = re.findall(r"\{(\d+) value\}(?: \[[^]]*\])? for (H = [\d.]+(?:, X from \S+ to \S+)?)", text)
    cases += [(row, case) for case, row in re.findall(r"differ most for (H = [\d.]+): by \{(\d+)", text)]
    assert len(cases) == len(re.findall(r"for H = ", text))
    cases += re.findall(r"\{(\d+) value\} \((H = [^)]+)\)", text)
    assert [TABLE.at[int(row), "case"] for row, _ in cases] == [case for _, case in cases]


def test_numbers_of_the_paper_are_the_expected_ones(text):
    columns_named = re.findall(r"paper(?:: | has )\{\d+ (\w+)\}(?: to \{\d+ (\w+)\})?", text)
    assert {column for columns in columns_named for column in columns if column} == {"expected"}
    assert len(columns_named) == text.count("the paper:") + text.count("the paper has")


def test_least_largest_and_ends_cover_all_cases():
    by_claim = dict(list(TABLE.groupby("claim")))
    assert abs(FOUND["coincide"]["value"].value) == by_claim["coincide"]["value"].abs().max()
    ranges = {"power_law": [("value", "value")], "gamma": [("least", "largest"), ("expected", "expected")]}
    for name, claim in (("spread", "power_law"), ("gamma", "gamma")):
        ends = [(by_claim[claim][low].min(), by_claim[claim][high].max()) for low, high in ranges[claim]]
        assert [number.value for number in FOUND[name]] == [end for pair in ends for end in pair]
    for name in ("elastic", "viscous"):
        assert [FOUND[name][end]["case"] for end in (0, -1)] == ["H = 0.1, not defined", "H = 0.9"]
