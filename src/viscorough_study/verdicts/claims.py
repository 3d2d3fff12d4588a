"""Judge the paper's claims: make a table of verdicts, derive the verdict on each claim, and summarize in Markdown.

A claim is tested in several cases, such as one case for each Hurst exponent. resources/paper/claims.yaml gives the
statement, kind, criterion and tolerance of every claim, and the reason for the tolerance. `JUDGES` lists the functions
that judge the claims. Such a function takes the evidence (verdicts.evidence.Evidence) and the tolerance, and yields the
cases of the claim.

Other random surfaces give other numbers, and a verdict must not depend on this choice. If a quantity has a 95 %
interval, the claim is reproduced only if the whole interval lies within the tolerance, and not reproduced only if the
whole interval lies outside. Otherwise it is undecided. The numbers of cases and of realizations also influence the
verdict, see verdicts.evidence.Evidence.within.

The scoreboard (`counted_verdicts`) counts only the claims on physics. Identities and bookkeeping cannot fail by the
physics, and statements beyond the paper are not claims of the paper.
"""

from collections import Counter

import numpy as np
import pandas as pd

from viscorough_study.verdicts import (
    form_criteria,
    law_criteria,
    mdr_criteria,
    method_criteria,
    region_criteria,
    zeta_criteria,
)
from viscorough_study.verdicts.evidence import VERDICTS

# {claim: function that judges it}. The sentence of each claim is its `statement` in resources/paper/claims.yaml.
JUDGES = {
    "history": form_criteria.history,
    "depth_over_rms": form_criteria.depth_over_rms,
    "one_surface": form_criteria.one_surface,
    "collapse": region_criteria.collapse,
    "first_region": region_criteria.first_region,
    "last_region": region_criteria.last_region,
    "separation": region_criteria.separation,
    "complete_contact": region_criteria.complete_contact,
    "complete_contact_end": region_criteria.complete_contact_end,
    "power_law": region_criteria.power_law,
    "power_law_decades": region_criteria.power_law_decades,
    "power_law_control": region_criteria.power_law_control,
    "beta": law_criteria.beta,
    "beta_lines": law_criteria.beta_lines,
    "coincide": law_criteria.coincide,
    "hurst_only": law_criteria.hurst_only,
    "no_grid": law_criteria.no_grid,
    "realizations": law_criteria.realizations,
    "alpha_limit": law_criteria.alpha_limit,
    "exponent_small_hurst": law_criteria.exponent_small_hurst,
    "exponent_limit": law_criteria.exponent_limit,
    "depth": law_criteria.depth,
    "zeta_elastic": zeta_criteria.zeta_elastic,
    "zeta_viscous": zeta_criteria.zeta_viscous,
    "zeta_better": zeta_criteria.zeta_better,
    "zeta_better_elastic": zeta_criteria.zeta_better_elastic,
    "equivalence": method_criteria.equivalence,
    "gamma": method_criteria.gamma,
    "master_curve": law_criteria.master_curve,
    "master_curve_shape": zeta_criteria.master_curve_shape,
    "one_constant": zeta_criteria.one_constant,
    "line_spectrum": method_criteria.line_spectrum,
    "lambda_constant": mdr_criteria.lambda_constant,
    "exact_correspondence": mdr_criteria.exact_correspondence,
    "whole_curve": mdr_criteria.whole_curve,
    "coincide_equal_windows": mdr_criteria.coincide_equal_windows,
    "line_area": mdr_criteria.line_area,
    "line_gap": mdr_criteria.line_gap,
    "single_surface": mdr_criteria.single_surface,
    "own_line": mdr_criteria.own_line,
    "bodies_of_revolution": method_criteria.bodies_of_revolution,
    "elements": method_criteria.elements,
    "contact_problems": method_criteria.contact_problems,
}
KINDS = {
    "physics": "Physics",
    "identity": "Identities, which hold by the method or by construction (not counted)",
    "bookkeeping": "Bookkeeping (not counted)",
    "beyond": "Beyond the paper (not counted)",
}
# Reasons why claims fail: {name of the reason in claims.yaml: reason in words}.
FINDINGS = {
    "small_hurst": "at small H, for which the paper claims no formula, the exponents of discs and lines differ",
    "prefactor": "the prefactor of Eq. 12 differs, from H = 0.4 on by one constant",
    "gamma": "the factor 1/Γ(2 − α) does not follow from Eqs. 1, 3 and 6",
    "region_c": "the slope 1 of region (c) begins before the contact is almost complete",
}
HELD = ("reproduced", "reproduced under a stated convention")  # verdicts of cases that meet their criterion
COLUMNS = {
    "claim": ("name of the claim, as in resources/paper/claims.yaml", ""),
    "kind": ("one of: " + "; ".join(KINDS), ""),
    "origin": ("own, or quoted from earlier work; missing where the paper makes no claim", ""),
    "where": ("equation, section or figure of the paper", ""),
    "quantity": ("what the value is", ""),
    "case": ("Hurst exponent or part that the row is about", ""),
    "value": ("quantity by which the claim is judged", "1"),
    "low": ("lower end of its 95 % interval, missing where it has no statistical scatter", "1"),
    "high": ("upper end of its 95 % interval", "1"),
    "least": ("smallest value over grids, windows, times or realizations, missing where there is one value", "1"),
    "largest": ("largest value over them", "1"),
    "expected": ("value stated by the paper", "1"),
    "tolerance": ("tolerance of the criterion", "1"),
    "verdict": ("one of: " + "; ".join(VERDICTS), ""),
    "convention": ("convention in which alone the claim holds, where it depends on one", ""),
    "conventions": ("combinations of the conventions that the paper leaves open, missing where none enters", "1"),
    "agreeing": ("number of them in which the case meets the criterion", "1"),
    "contradicting": ("number of them in which it is outside; the others are undecided", "1"),
    "criterion": ("when the claim counts as reproduced", ""),
    "reason": ("why the tolerance is what it is", ""),
    "figure": ("figure that shows it", ""),
}
# A study is a trial if its discs have fewer elements across than this share of the paper's number. On such coarse grids
# region (b) is too short for a fit.
SMALLEST_SHARE = 0.5
CASES_SHOWN_MAX = 10  # if a claim has more cases, the summary shows only three of them


def judge(claims, evidence):
    """Judge the claims; return a pandas.DataFrame with the columns of `COLUMNS`.

    A claim is tested in several cases, such as one case for each Hurst exponent. The table has one row for each case.

    claims : {name: title, quantity, kind, where, statement, criterion, tolerance, reason, figure}
    evidence : verdicts.evidence.Evidence
    A case is undecided if its quantity cannot be computed from the evidence, such as an exponent without a region (b).
    """
    rows = []
    for name, claim in claims.items():
        described = {"claim": name, "origin": "", **claim, "reason": reason(claim)}
        rows += [described | case for case in JUDGES[name](evidence, claim["tolerance"])]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def reason(claim):
    """Return why the tolerance of a claim is what it is, marked if it is an assumption on the paper's printed figures.

    claim : entry of claims.yaml
    """
    return (
        "assumption, as only the text of the paper was available: " * claim.get("assumption", False) + claim["reason"]
    )


def is_trial(elements_across, paper_elements_across):
    """Return True if the discs have too few elements across to show a power law; the verdicts then mean nothing."""
    return elements_across < SMALLEST_SHARE * paper_elements_across


def scale_attributes(evidence):
    """Return attributes for the table of verdicts that state the size of the study.

    The numbers are taken from the results, not from the settings:

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


def overall(table):
    """Return {claim: verdict}; the verdict on a claim follows from the verdicts on its cases.

    A claim is tested in several cases. If some cases hold and others fail, the claim is reproduced in part. Otherwise
    the claim has the worst verdict of its cases, in the order of `VERDICTS`. So a claim with failing cases but no
    holding cases is not reproduced, and a claim with holding and undecided cases is undecided.
    """
    return {claim: _of_cases(verdicts) for claim, verdicts in table.groupby("claim", sort=False)["verdict"]}


def _of_cases(verdicts):
    """Return the verdict on a claim from the verdicts on its cases, such as Hurst exponents (see `overall`)."""
    if "not reproduced" in set(verdicts) and verdicts.isin(HELD).any():
        return "reproduced in part"
    return max(verdicts, key=VERDICTS.index)


def counted_verdicts(table, origin):
    """Return [(verdict, number of claims on physics with this verdict)], from best to worst.

    origin : "own" for claims of the paper itself, "quoted" for claims that the paper takes from earlier work
    """
    rows = physics(table)
    numbers = Counter(overall(rows[rows["origin"] == origin]).values())
    return [(verdict, numbers[verdict]) for verdict in VERDICTS if numbers[verdict]]


def physics(table):
    """Return the rows of a table of verdicts that belong to claims on physics, which the scoreboard counts."""
    return table[table["kind"] == "physics"]


def verdict_text(rows):
    """Return the verdict on a claim as text.

    rows : rows of the table of verdicts for this claim, one for each case, such as a Hurst exponent
    If the claim is reproduced in part and its cases are Hurst exponents, the text lists the Hurst exponents for which
    the claim holds.
    """
    (verdict,) = overall(rows).values()
    held = rows.loc[rows["verdict"].isin(HELD), "case"]
    if verdict == "reproduced in part" and held.str.fullmatch(r"H = [\d.]+").all():
        return f"{verdict} (H = {', '.join(held.str.removeprefix('H = '))})"
    return verdict


def case_counts(rows):
    """Return how many cases of a claim hold or fail, as text such as "2 of 4 cases hold, 1 undecided".

    rows : rows of the table of verdicts for one claim, one for each case, such as a Hurst exponent. The text is empty
        if all cases have the same outcome. Undecided cases are counted if other cases fail
    """
    held, undecided = int(rows["verdict"].isin(HELD).sum()), int((rows["verdict"] == "undecided").sum())
    failed = len(rows) - held - undecided
    if len(rows) in (held, failed, undecided):
        return ""
    text = f"{held} of {len(rows)} cases hold" if held else f"{failed} of {len(rows)} cases fail"
    return text + (f", {undecided} undecided" if undecided and failed else "")


def findings(table, claims):
    """Return {reason in words: claims that failed for this reason}.

    Claims on physics are included if they are not reproduced, or if they are reproduced only in part.
    claims : {name: entry of claims.yaml}; the key `finding` of an entry is the name of the reason in `FINDINGS`
    """
    verdicts = overall(physics(table))
    failed = [name for name, verdict in verdicts.items() if verdict in ("reproduced in part", "not reproduced")]
    found = {finding: [name for name in failed if claims[name].get("finding") == finding] for finding in FINDINGS}
    return {FINDINGS[finding]: names for finding, names in found.items() if names}


def place(claim):
    """Return the place of a claim in the paper as text, marked as quoted if the paper quotes earlier work.

    claim : entry of claims.yaml
    """
    return claim["where"] + ("; quoted" if claim.get("origin") == "quoted" else "")


def deciding_case(rows):
    """Return the index of the row that decides the verdict on a claim.

    Among the rows with the worst verdict, the row whose value is farthest from the paper's value decides. If the paper
    states no value for any of these rows, the first of them decides.

    rows : rows of the table of verdicts for one claim, one for each case, such as a Hurst exponent
    """
    rows = rows[rows["verdict"] == max(rows["verdict"], key=VERDICTS.index)]
    distance = (rows["value"] - rows["expected"]).abs()
    return rows.index[0] if distance.isna().all() else distance.idxmax()


def markdown(table, claims):
    """Return the verdicts as Markdown tables, one table for each kind of claim.

    A table has a row for each claim, followed by rows for its cases. If a claim has more than `CASES_SHOWN_MAX` cases,
    only three are shown: the first, the last, and the case farthest from the paper's value. The verdict of a case is
    followed by the number of conventions that meet the criterion.
    """
    parts, verdicts = [], overall(table)
    for kind, heading in KINDS.items():
        names = [name for name in verdicts if claims[name]["kind"] == kind]
        if not names:
            continue
        lines = [f"### {heading}", "", "| claim, case | quantity, value | the paper | verdict |", "|---|---|---|---|"]
        for name in names:
            claim, rows = claims[name], table[table["claim"] == name]
            verdict, counts = verdict_text(rows), case_counts(rows)
            verdict = f"**{verdict}**; {counts}" if counts else f"**{verdict}**"
            lines.append(f"| **{claim['statement']}** ({place(claim)}) | {claim['quantity']} | | {verdict} |")
            shown = cases_shown(rows)
            lines += [_case_line(row) for row in shown.to_dict("records")]
            lines += [f"| {len(rows) - len(shown)} more cases | | | |"] if len(shown) < len(rows) else []
        parts.append("\n".join(lines) + "\n")
    return "\n".join(parts)


def cases_shown(rows):
    """Return the rows of a claim that a summary shows: all rows, or three if there are more than `CASES_SHOWN_MAX`.

    rows : rows of the table of verdicts for one claim, one for each case, such as a Hurst exponent
    The docstring of `markdown` says which three rows are shown.
    """
    if len(rows) <= CASES_SHOWN_MAX:
        return rows
    farthest = np.abs(rows["value"] - rows["expected"]).fillna(0).idxmax()
    return rows.loc[sorted({rows.index[0], farthest, rows.index[-1]})]


def _case_line(row):
    """Return a row of the table of verdicts as a row of a Markdown table."""
    said = _digits(row["expected"]) if np.isfinite(row["expected"]) else ""
    verdict = row["verdict"] + (f": {row['convention']}" if row["convention"] else "")
    if np.isfinite(row["conventions"]):
        agreeing, contradicting = f"{row['agreeing']:.0f}", f"{row['contradicting']:.0f}"
        verdict += f"; in {agreeing} of {row['conventions']:.0f} conventions, outside in {contradicting}"
    return f"| {row['case']} | {value_text(row)} | {said} | {verdict} |"


def value_text(row):
    """Return the value in a row of the table of verdicts as text, with its interval and its least and largest value."""
    if not np.isfinite(row["value"]):
        return "–"
    text = _digits(row["value"])
    if np.isfinite(row["low"]):
        text += f" [{_digits(row['low'])}, {_digits(row['high'])}]"
    if np.isfinite(row["least"]):
        text += f", least {_digits(row['least'])}, largest {_digits(row['largest'])}"
    return text


def _digits(number):
    return f"{number:.0f}" if abs(number) >= 1e3 else f"{number:.3g}"
