"""Verdicts on the paper's claims: a table of all cases, the verdict on each claim, and a summary in Markdown.

What a claim says and by which criterion it is judged stands in resources/paper/claims.yaml; viscorough_study.criteria
has the function of each criterion, under the name of the claim.
"""

from dataclasses import astuple

import numpy as np
import pandas as pd

from viscorough_study.criteria import JUDGES
from viscorough_study.evidence import VERDICTS

COLUMNS = {
    "claim": ("name of the claim, as in resources/paper/claims.yaml", ""),
    "where": ("equation, section or figure of the paper", ""),
    "case": ("Hurst exponent or part that the row is about", ""),
    "value": ("quantity by which the claim is judged", "1"),
    "low": ("lower end of its 95 % interval, or least value", "1"),
    "high": ("upper end of its 95 % interval, or largest value", "1"),
    "expected": ("what the paper says", "1"),
    "tolerance": ("tolerance of the criterion", "1"),
    "verdict": ("one of: " + "; ".join(VERDICTS), ""),
    "convention": ("convention in which the claim holds, where it does not in those of the figures", ""),
    "criterion": ("when the claim counts as reproduced", ""),
    "figure": ("figure that shows it", ""),
}
CASES_SHOWN_MAX = 10  # cases of a claim, beyond which the summary shows three of them


def judge(claims, evidence):
    """Verdicts on the claims; a pandas.DataFrame with the columns of `COLUMNS`, a row for every case of a claim.

    claims : {name: where, statement, criterion, tolerance, figure}
    A case whose quantity cannot be computed from the evidence, such as an exponent where there is no region (b), is
    not testable. Raises ValueError for a claim that has no criterion.
    """
    rows = []
    for name, claim in claims.items():
        if name not in JUDGES:
            raise ValueError(f"claim {name}: no criterion computes it; known are {', '.join(JUDGES)}")
        for case in JUDGES[name](evidence, claim["tolerance"]):
            case_name, value, low, high, expected, verdict, convention = astuple(case)
            numbers = value, low, high, expected, claim["tolerance"]
            rows.append(
                (name, claim["where"], case_name, *numbers, verdict, convention, claim["criterion"], claim["figure"])
            )
    return pd.DataFrame(rows, columns=list(COLUMNS))


def overall(table):
    """{claim: verdict} over all cases of a claim: the worst of those that are testable."""
    verdicts = {}
    for claim, rows in table.groupby("claim", sort=False):
        ranks = [VERDICTS.index(verdict) for verdict in rows["verdict"] if verdict != "not testable"]
        verdicts[claim] = VERDICTS[max(ranks)] if ranks else "not testable"
    return verdicts


def markdown(table, claims):
    """The verdicts as a table in Markdown, a row for each claim with its statement, its cases and the verdict.

    Of more than `CASES_SHOWN_MAX` cases it shows the first, the last, and the one that is farthest from what the paper
    says.
    """
    lines = ["| the paper says | where | computed [95 % interval] | verdict |", "|---|---|---|---|"]
    for name, verdict in overall(table).items():
        cases = _cases_in_words(table[table["claim"] == name])
        lines.append(f"| {claims[name]['statement']} | {claims[name]['where']} | {cases} | {verdict} |")
    return "\n".join(lines) + "\n"


def cases_shown(rows):
    """The cases of a claim that a summary shows: all, or of more than `CASES_SHOWN_MAX` three."""
    if len(rows) <= CASES_SHOWN_MAX:
        return rows
    farthest = np.abs(rows["value"] - rows["expected"]).idxmax()
    return rows.loc[sorted({rows.index[0], farthest, rows.index[-1]})]


def _cases_in_words(rows):
    shown = cases_shown(rows)
    number = f"{len(rows)} cases, of which " if len(shown) < len(rows) else ""
    return number + "; ".join(_case_in_words(row) for _, row in shown.iterrows())


def _case_in_words(row):
    """Name, value and interval of a case, with what the paper says."""
    if not np.isfinite(row["value"]):
        return f"{row['case']}: –"
    numbers = [row[name] for name in ("value", "low", "high", "expected")]
    value, low, high, said = (f"{number:.0f}" if abs(number) >= 1e3 else f"{number:.3g}" for number in numbers)
    return f"{row['case']}: {value} [{low}, {high}]" + (f", paper {said}" if np.isfinite(numbers[-1]) else "")
