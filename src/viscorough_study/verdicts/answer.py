"""Answer the study's question in one paragraph: where the results agree with the paper, and by how much they differ."""

import numpy as np

from viscorough_study.verdicts.claims import HELD, overall

# Texts by the outcome of a claim: True if the claim holds, False if it fails, None if the data do not decide.
EQUIVALENCE = {
    True: "By direct integration the viscous problem is equivalent to the elastic problem, as the paper derives",
    False: "By direct integration the viscous problem is not equivalent to the elastic problem",
}
COLLAPSE = {
    True: "The curves of each Hurst exponent collapse",
    False: "The curves of each Hurst exponent do not collapse",
    None: "Whether the curves of each Hurst exponent collapse is undecided",
}
GAMMA = {
    True: "The factor 1/Γ(2 − α) of Eqs. 7 to 9 is confirmed",
    False: "The factor 1/Γ(2 − α) of Eqs. 7 to 9 does not follow from Eqs. 1, 3 and 6, and direct integration does not "
    "have it; it changes neither the exponent nor the collapse",
}


def answer(table):
    """Return the answer as a paragraph of plain text, from a table of verdicts (verdicts.claims.judge).

    For claims on exponents, the paragraph lists the Hurst exponents at which they hold. For other Hurst exponents, it
    gives the difference from the paper. Claims that the data do not decide are left out, except the claims on exponents
    and on the collapse of the curves.
    """
    verdicts = {claim: _outcome(verdict) for claim, verdict in overall(table).items()}
    sentences = [
        EQUIVALENCE.get(verdicts["equivalence"], ""),
        COLLAPSE[verdicts["collapse"]],
        _boundary_elements(table),
        _fine_grids(table),
        _reduction(table),
        _master_curve(table, verdicts),
        GAMMA.get(verdicts["gamma"], ""),
        _region_c(table, verdicts),
    ]
    return " ".join(f"{sentence}." for sentence in sentences if sentence)


def short_answer(table):
    """Return the answer as a list of at most three short sentences, from a table of verdicts (verdicts.claims.judge).

    They state the equivalence and the collapse, the exponent by boundary elements, and what fails of the prefactor.
    Claims that the data do not decide are left out, except the claim on the collapse.
    """
    verdicts = {claim: _outcome(verdict) for claim, verdict in overall(table).items()}
    collapse = COLLAPSE[verdicts["collapse"]]
    if verdicts["equivalence"] and verdicts["collapse"]:
        collapse = (
            "As the paper says, the viscous problem follows from the elastic one, and for each Hurst exponent H "
            "(small: rugged) the curves of all forces, viscosities, sizes and rms heights collapse onto one"
        )
    cases, parts = _exponents(table, "beta", "discs"), []
    if holding := _hursts(cases, HELD):
        within = np.ceil(100 * max(abs(case["difference"]) for case in cases.values() if case["verdict"] in HELD)) / 100
        parts.append(f"is H/(1 + H) within {within:.2f} at H = {_joined(holding)} (the paper: “at least for H > 0.4”)")
    small = table.loc[table["claim"] == "exponent_small_hurst", "case"].map(_hurst)
    for sign, word in ((1, "larger"), (-1, "smaller")):
        apart = {
            hurst: f"by {abs(case['difference']):.2f} at H = {hurst:g}"
            for hurst, case in cases.items()
            if case["verdict"] == "not reproduced" and sign * case["difference"] > 0
        }
        unclaimed = ", where it claims nothing" if set(apart) <= set(small) else ""
        parts += [f"{word} {_joined(list(apart.values()))}{unclaimed}"] if apart else []
    exponent = (
        f"In their middle part, vt/h is a power of time whose exponent {_joined(parts, comma=True)}" if parts else ""
    )
    failing = ["the prefactor of Eq. 12"] if verdicts["master_curve"] is False else []
    failing += ["the factor 1/Γ(2 − α) of Eqs. 7 to 9"] if verdicts["gamma"] is False else []
    unconfirmed = f"Not reproduced: {_joined(failing)}; the exponent does not depend on them" if failing else ""
    return [f"{sentence}." for sentence in (collapse, exponent, unconfirmed) if sentence]


def _outcome(verdict):
    """Return True for the verdict on a claim that holds, False for "not reproduced", and None otherwise."""
    return True if verdict in HELD else False if verdict == "not reproduced" else None


def _master_curve(table, verdicts):
    """Return the sentence on Eq. 12, as printed and up to one constant, or "" if the claims are undecided.

    verdicts : {claim: result of `_outcome`}
    """
    if verdicts["master_curve"]:
        return "Eq. 12 describes the curves in region (b)"
    constants = table.loc[(table["claim"] == "one_constant") & table["verdict"].isin(HELD), "case"]
    if constants.empty:
        return "Eq. 12 does not describe the curves in region (b)" if verdicts["master_curve"] is False else ""
    named = [
        f"{quantity} times {factor}" for quantity, factor in constants.str.extract(r", (\S+) times (\S+)").to_numpy()
    ]
    _, hurst, *_ = constants.iloc[0].removeprefix("H ").split()
    return f"From H = {hurst} on, Eq. 12 describes the discs in region (b) up to one constant, {' or '.join(named)}"


def _region_c(table, verdicts):
    """Return the sentence on the contact where region (c) begins, or "" if the claim is undecided.

    verdicts : {claim: result of `_outcome`}
    """
    if verdicts["complete_contact"]:
        return "Region (c) begins near complete contact"
    if verdicts["complete_contact"] is None:
        return ""
    rows = table[(table["claim"] == "complete_contact") & table["value"].notna()]
    parts = []
    for slope, cases in rows.groupby(rows["case"].str.extract(r"slope within ([\d.]+)")[0], sort=False):
        least, most = (f"{100 * share:.0f}" for share in (cases["value"].min(), cases["value"].max()))
        hursts = [_hurst(case) for case in cases["case"]]
        parts.append(f"{least} to {most} % where the slope is 1 within {slope} (H = {hursts[0]:g} to {hursts[-1]:g})")
    return (
        f"Region (c), for the paper an almost complete contact, begins with fewer elements in contact: {_joined(parts)}"
    )


def _boundary_elements(table):
    """Return the sentence on the exponent β by boundary elements, which mentions all Hurst exponents of the discs."""
    cases = _exponents(table, "beta", "discs")
    holding, parts = [case["difference"] for case in cases.values() if case["verdict"] in HELD], []
    if holding:
        within = np.ceil(100 * np.abs(holding).max()) / 100
        hursts = _joined(_hursts(cases, HELD))
        parts.append(f"is within {within:.2f} of H/(1 + H) at H = {hursts} (the paper: “at least for H > 0.4”)")
    differences = [(case["difference"], hurst) for hurst, case in cases.items() if case["verdict"] == "not reproduced"]
    for sign, word in ((1, "larger"), (-1, "smaller")):
        named = [f"by {abs(d):.2f} at {hurst:g}" for d, hurst in reversed(differences) if d * sign > 0]
        parts += [f"{word} {_joined(named)}"] if named else []
    parts += [f"undecided at {_joined(_hursts(cases, ('undecided',)))}"] if _any(cases, ("undecided",)) else []
    return f"By boundary elements on the paper's grid the exponent {_joined(parts, comma=True)}" if parts else ""


def _fine_grids(table):
    """Return the sentence on the exponent β on fine grids and at small X, or "" if there are no results."""
    rows = table[(table["claim"] == "exponent_limit") & table["value"].notna()]
    words = {
        "reproduced": "tends to H/(1 + H)",
        "not reproduced": "departs from H/(1 + H)",
        "undecided": "is undecided",
    }
    parts = []
    for verdict, word in words.items():
        hursts = [f"{_hurst(case):g}" for case in rows.loc[rows["verdict"] == verdict, "case"]]
        parts += [f"{word} at H = {_joined(hursts)}"] if hursts else []
    return f"On finer grids and at smaller X it {_joined(parts, comma=True)}" if parts else ""


def _reduction(table):
    """Return the sentence on the exponent β of the MDR, and on its difference from β by boundary elements.

    The MDR is the method of dimensionality reduction.
    """
    cases = _exponents(table, "beta_lines", "lines")
    text = "The method of dimensionality reduction (MDR) "
    failing = [hurst for hurst, case in cases.items() if case["verdict"] not in HELD]
    holding = [hurst for hurst in cases if hurst > max(failing, default=-1.0)]
    parts = [f"gives H/(1 + H) from {holding[0]:g} on"] if holding else []
    rows = table[(table["claim"] == "coincide") & (table["verdict"] == "not reproduced")]
    equal = table[(table["claim"] == "coincide_equal_windows") & table["case"].str.endswith("same X")]
    windows = {_hurst(row.case): f" ({abs(row.value):.2f} in equal ranges of X)" for row in equal.itertuples()}
    apart = [
        f"by {abs(row.value):.2f} at {(h := _hurst(row.case)):g}{windows.get(h, '')}" for row in rows[::-1].itertuples()
    ]
    if apart:
        differs = f"differs from boundary elements {_joined(apart)}, where the paper sees them nearly coincide"
        parts.append(f"it {differs}" if parts else differs)
    return text + "; ".join(parts) if parts else ""


def _exponents(table, claim, source):
    """Return {H: {"verdict": verdict, "difference": β − H/(1 + H)}} of discs or lines, by ascending H.

    table : table of verdicts; source : "discs" or "lines"
    claim : name of the claim on the larger Hurst exponents; the claim exponent_small_hurst covers the smaller exponents
    """
    claimed, small = table[table["claim"] == claim], table[table["claim"] == "exponent_small_hurst"]
    small = small[small["case"].str.endswith(source)]
    cases = {
        _hurst(row.case): {"verdict": row.verdict, "difference": row.value - row.expected}
        for rows in (small, claimed)
        for row in rows.itertuples()
    }
    return dict(sorted(cases.items()))


def _hurst(case):
    """Return the Hurst exponent from an entry of the column `case` of the verdicts, such as "H = 0.4, discs"."""
    return float(case.removeprefix("H = ").split(",")[0])


def _hursts(cases, verdicts):
    return [f"{hurst:g}" for hurst, case in cases.items() if case["verdict"] in verdicts]


def _any(cases, verdicts):
    return any(case["verdict"] in verdicts for case in cases.values())


def _joined(texts, *, comma=False):
    """Join texts by commas, and the last two by "and".

    comma : True if a comma precedes "and"
    """
    *first, last = texts
    return ", ".join(first) + (", and " if comma else " and ") + last if first else last
