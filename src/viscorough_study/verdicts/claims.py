"""List all claims, judge them, and derive the verdict on each claim from the verdicts on its cases.

A case holds, does not hold ("not"), or is undecided (verdicts.evidence). A claim that depends on how the discs were
made is judged in two readings of the paper, A and B. The cases of a claim in one reading form a column:

- If some cases hold and others do not, the column holds in part. Otherwise it has the worst verdict of its cases.
- If the columns of both readings have the same verdict, this is the verdict on the claim. If exactly one column holds,
  the claim holds in A or holds in B. Otherwise the claim has the better verdict of the two, with the reading named.

Reading B was found by trying conventions after the first results were known. A verdict that rests on it says so.
"""

from collections import Counter
from dataclasses import dataclass

import pandas as pd

from viscorough_study.verdicts import curves, exponents, identities, lines, methods, prefactors
from viscorough_study.verdicts.claim import KINDS

# All claims, in the order in which pages show them.
CLAIMS = (
    methods.equivalence,
    curves.collapse,
    curves.separation,
    curves.power_law,
    curves.power_law_control,
    exponents.beta,
    exponents.exponent_small_hurst,
    exponents.exponent_limit,
    lines.beta_lines,
    lines.coincide,
    lines.alpha_limit,
    prefactors.master_curve,
    prefactors.master_curve_shape,
    prefactors.one_constant,
    prefactors.zeta_better,
    prefactors.zeta_elastic,
    lines.line_master_curve,
    curves.depth,
    methods.gamma,
    curves.last_region,
    curves.complete_contact,
    lines.line_spectrum,
    lines.lambda_constant,
    lines.exact_correspondence,
    lines.line_area,
    lines.line_gap,
    identities.identities,
)
WORDS = ("holds", "holds in A", "holds in B", "in part", "undecided", "not")  # verdicts on a claim, from best to worst
AFTER_THE_FACT = "found after the fact, by trying conventions"  # said of verdicts that rest on reading B
COLUMNS = {
    "claim": ("name of the claim, which is the name of the function that judges it", ""),
    "title": ("the claim in a few words", ""),
    "kind": ("one of: " + ", ".join(KINDS), ""),
    "where": ("equation, section or figure of the paper", ""),
    "reading": (
        "reading of the surfaces, A or B; missing where the claim is judged in A only, or depends on neither",
        "",
    ),
    "quantity": ("what the value is", ""),
    "case": ("Hurst exponent or part that the row is about", ""),
    "value": ("quantity by which the claim is judged", "1"),
    "low": ("lower end of its 95 % interval, missing where it has no statistical scatter", "1"),
    "high": ("upper end of its 95 % interval", "1"),
    "least": ("smallest value over windows, times or realizations, missing where there is one value", "1"),
    "largest": ("largest value over them", "1"),
    "expected": ("value stated by the paper", "1"),
    "tolerance": ("tolerance of the criterion", "1"),
    "verdict": ("verdict on the case: holds, undecided, not", ""),
    "note": ("words on the case", ""),
    "criterion": ("when a case holds", ""),
    "reason": ("why the tolerance is what it is", ""),
    "figure": ("figure that shows it", ""),
}
# A study is a trial if its discs have fewer elements across than this share of the paper's number. On such coarse grids
# region (b) is too short for a fit.
SMALLEST_SHARE = 0.5


def judge(evidence, claims=CLAIMS):
    """Judge claims; return a pandas.DataFrame with the columns of `COLUMNS`, and one row for each case and reading.

    evidence : verdicts.evidence.Evidence in reading A
    A case is undecided if its quantity cannot be computed from the evidence, such as an exponent without a region (b).
    """
    rows = []
    for claim in claims:
        names = ("title", "kind", "where", "quantity", "tolerance", "criterion", "figure")
        described = {name: getattr(claim, name) for name in names}
        described |= {"claim": claim.name, "reason": claim.stated_reason}
        for reading, given in (evidence.readings if claim.readings else {"": evidence}).items():
            rows += [described | {"reading": reading} | case for case in claim.judge(given, claim.tolerance)]
    return pd.DataFrame(rows, columns=list(COLUMNS))


@dataclass(frozen=True)
class Verdict:
    """The verdict on a claim.

    word : one of `WORDS`; text : the verdict with the reading and the Hurst exponents at which the claim holds
    columns : {reading: verdict of its column as text}
    """

    word: str
    text: str
    columns: dict[str, str]


def verdict_on(rows):
    """Return the Verdict on a claim; rows : rows of the table of verdicts for this claim."""
    columns = {reading: _column(of_reading) for reading, of_reading in rows.groupby("reading", sort=False)}
    texts = {reading: f"{word}{where}" for reading, (word, where) in columns.items()}
    words = {reading: word for reading, (word, _) in columns.items()}
    best = min(words, key=lambda reading: WORDS.index(words[reading]))
    word, where = columns[best]
    if len(set(words.values())) == 1:
        same = where if len(words) == 1 else ""
        return Verdict(word, word + same, texts)
    text = f"{word} in {best}{where}" + f"; {AFTER_THE_FACT}" * (best == "B")
    return Verdict(f"holds in {best}" if word == "holds" else word, text, texts)


def _column(rows):
    """Return the verdict of the cases in one reading, and words on which cases decide it if the cases differ."""
    verdicts = set(rows["verdict"])
    word = "in part" if {"holds", "not"} <= verdicts else max(verdicts, key=WORDS.index)
    if len(verdicts) == 1:
        return word, ""
    deciding = rows.loc[rows["verdict"] == ("holds" if word == "in part" else word), "case"]
    if deciding.str.fullmatch(r"H = [\d.]+").all():
        return word, f" at H = {', '.join(deciding.str.removeprefix('H = '))}"
    return word, f", {len(deciding)} of {len(rows)} cases"


def verdicts_of(table):
    """Return {name of a claim: Verdict} from a table of verdicts (see `judge`), also if it was read from a CSV file."""
    table = table.assign(reading=table["reading"].fillna(""))
    return {name: verdict_on(rows) for name, rows in table.groupby("claim", sort=False)}


def counted_verdicts(table, kind):
    """Return [(verdict, number of claims of a kind with this verdict)], from best to worst."""
    numbers = Counter(verdict.word for verdict in verdicts_of(table[table["kind"] == kind]).values())
    return [(word, numbers[word]) for word in WORDS if numbers[word]]


def is_trial(elements_across, paper_elements_across):
    """Return True if the discs have too few elements across to show a power law; the verdicts then mean nothing."""
    return elements_across < SMALLEST_SHARE * paper_elements_across


def scale_attributes(evidence):
    """Return attributes for the table of verdicts that state the size of the study.

    elements_across : number of elements across the discs
    paper_elements_across : number of elements across the discs of the paper
    realizations : smallest number of discs per Hurst exponent
    trial : 1 if the study is a trial, whose verdicts mean nothing, otherwise 0
    scale : a sentence with these numbers
    """
    across, paper = evidence.across, evidence.paper_value("boundary_elements", "elements_across")
    realizations = min(ensemble.sizes["realization"] for ensemble in evidence.pooled.values())
    trial = is_trial(across, paper)
    words = f"at least {realizations} discs of {across} elements across for every Hurst exponent"
    words += f" (paper: {paper} across)" + "; too coarse for a power law, the verdicts mean nothing" * trial
    counts = {"elements_across": across, "paper_elements_across": paper, "realizations": realizations}
    return counts | {"trial": int(trial), "scale": words}
