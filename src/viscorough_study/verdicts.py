"""The paper's claims, judged: for each a quantity computed from ensembles and tables, its interval, and a verdict.

What a claim says and by which criterion it is judged stands in resources/paper/claims.yaml; the quantity of a claim is
computed by the function of its name in viscorough_study.criteria.
"""

from dataclasses import dataclass

import numpy as np
import pandas as pd

from viscorough_study.criteria import JUDGES, VERDICTS
from viscorough_study.ensembles import combine
from viscorough_study.power_law import find_region

COLUMNS = {
    "claim": ("name of the claim, as in resources/paper/claims.yaml", ""),
    "where": ("equation, section or figure of the paper", ""),
    "case": ("Hurst exponent or part that the row is about", ""),
    "value": ("what was computed", "1"),
    "low": ("lower end of its 95 % interval, or least value", "1"),
    "high": ("upper end of its 95 % interval, or largest value", "1"),
    "expected": ("what the paper says", "1"),
    "tolerance": ("tolerance of the criterion", "1"),
    "verdict": ("one of: " + "; ".join(VERDICTS), ""),
    "convention": ("convention under which the claim holds, where it does not under those shown", ""),
    "criterion": ("when the claim counts as reproduced", ""),
    "figure": ("figure that shows it", ""),
}
MANY = 10  # cases of a claim that are more than a table of verdicts shows


@dataclass(frozen=True)
class Evidence:
    """What claims are judged by.

    discs, lines : {H: list of ensembles, one for each combination}, {H: ensemble}
    scaling, validation, direct : the tables of these names, shown : conventions of the figures, {column: value}
    across : elements across a disc; limits : elements_min, stiffness_max, slope_max of region (b)
    resamples, seed : of bootstraps
    """

    discs: dict
    lines: dict
    scaling: pd.DataFrame
    validation: pd.DataFrame
    direct: pd.DataFrame
    shown: dict
    across: int
    limits: dict
    resamples: int
    seed: int

    def pooled(self, hurst):
        """All discs of a Hurst exponent in the rms convention shown, and the window of region (b), None without."""
        mean = combine(self.discs[hurst]).sel(rms_convention=self.shown["rms_convention"])
        try:
            return mean, find_region(mean, **self.limits)
        except ValueError:
            return mean, None

    def fits(self, source, **conventions):
        """Rows of the scaling table by Hurst exponent, under the conventions shown but for those given."""
        wanted = self.shown | conventions
        if source == "lines":
            wanted |= {"rms_convention": "line"}
        table = self.scaling[(self.scaling["source"] == source) & (self.scaling["case_group"] == "base")]
        for name, value in wanted.items():
            table = table[table[name] == value]
        return table.set_index("hurst").sort_index()


def judge(claims, evidence):
    """Verdicts on the claims; a pandas.DataFrame with the columns of `COLUMNS`, a row for every case of a claim.

    claims : {name: where, statement, criterion, tolerance, figure}
    A case whose quantity cannot be computed from the evidence, such as an exponent where there is no region (b), is
    not testable. Raises ValueError for a claim that no function here computes.
    """
    rows = []
    for name, claim in claims.items():
        if name not in JUDGES:
            raise ValueError(f"claim {name}: nothing computes it; known are {', '.join(JUDGES)}")
        for case, value, low, high, expected, verdict, convention in JUDGES[name](evidence, claim["tolerance"]):
            about = claim["tolerance"], verdict, convention, claim["criterion"], claim["figure"]
            rows.append((name, claim["where"], case, value, low, high, expected, *about))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def overall(table):
    """{claim: verdict} over all cases of a claim: the worst of them; untestable ones count where all are."""
    order = [VERDICTS.index(name) for name in VERDICTS]
    result = {}
    for name, rows in table.groupby("claim", sort=False):
        ranks = [VERDICTS.index(verdict) for verdict in rows["verdict"] if verdict != "not testable"]
        result[name] = VERDICTS[max(ranks, default=order[-1])]
    return result


def markdown(table, claims):
    """The verdicts as a table in Markdown: statement, where, what was found, with interval, and is said, verdict.

    Of many cases the first and the last are shown, and the one that is farthest from what is said.
    """

    def found(row):
        if not np.isfinite(row["value"]):
            return f"{row['case']}: –"
        value, low, high, said = (
            f"{row[name]:.0f}" if abs(row[name]) >= 1e3 else f"{row[name]:.3g}"
            for name in ("value", "low", "high", "expected")
        )
        return f"{row['case']}: {value} [{low}, {high}]" + (f", said {said}" if np.isfinite(row["expected"]) else "")

    lines = ["| the paper says | where | found [95 % interval] | verdict |", "|---|---|---|---|"]
    for name, verdict in overall(table).items():
        rows = table[table["claim"] == name]
        many = f"{len(rows)} cases, of which " if len(rows) > MANY else ""
        if many:
            farthest = np.abs(rows["value"] - rows["expected"]).idxmax()
            rows = rows.loc[sorted({rows.index[0], farthest, rows.index[-1]})]
        cases = many + "; ".join(found(row) for _, row in rows.iterrows())
        lines.append(f"| {claims[name]['statement']} | {claims[name]['where']} | {cases} | {verdict} |")
    return "\n".join(lines) + "\n"
