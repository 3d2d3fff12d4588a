"""Answer the study's question in one paragraph: where the results agree with the paper, and by how much they differ."""

from viscorough_study.verdicts.claims import HELD, overall

# Texts by the outcome of a claim: True if the claim holds, False if it fails, None if the data do not decide.
COLLAPSE = {
    True: "The curves of each Hurst exponent collapse",
    False: "The curves of each Hurst exponent do not collapse",
    None: "Whether the curves of each Hurst exponent collapse is undecided",
}
PREFACTORS = {True: "the prefactors are those of the paper", False: "the prefactors differ from the paper's"}
GAMMA = {True: "the factor 1/Γ(2 − α) is confirmed", False: "the factor 1/Γ(2 − α) is an error"}
REGION_C = {
    True: "region (c) begins near complete contact",
    False: "region (c) begins far before complete contact",
}


def answer(table):
    """Return the answer as a paragraph of plain text, from a table of verdicts (verdicts.claims.judge).

    For claims on exponents, the paragraph lists the Hurst exponents at which they hold. For other Hurst exponents, it
    gives the difference from the paper. Claims that the data do not decide are left out, except the claims on exponents
    and on the collapse of the curves.
    """
    verdicts = overall(table)
    last = [_statement(verdicts, names, texts) for names, texts in _LAST]
    last = [text for text in last if text]
    sentences = [
        COLLAPSE[_outcome(verdicts["collapse"])],
        _boundary_elements(table),
        _reduction(table),
        _capitalized(_joined(last)) if last else "",
    ]
    return " ".join(f"{sentence}." for sentence in sentences if sentence)


_LAST = (
    (("zeta_elastic", "zeta_viscous"), PREFACTORS),
    (("gamma",), GAMMA),
    (("complete_contact",), REGION_C),
)


def _outcome(verdict):
    """Return True for the verdict on a claim that holds, False for "not reproduced", and None otherwise."""
    return True if verdict in HELD else False if verdict == "not reproduced" else None


def _statement(verdicts, names, texts):
    """Return the sentence on the common outcome of several claims, or "" if their outcomes differ or have no sentence.

    verdicts : {claim: verdict}; names : the claims; texts : {outcome: sentence}
    """
    outcomes = {_outcome(verdicts[name]) for name in names}
    return texts.get(outcomes.pop(), "") if len(outcomes) == 1 else ""


def _boundary_elements(table):
    """Return the sentence on the exponent β by boundary elements, which mentions all Hurst exponents of the discs."""
    cases = _exponents(table, "beta", "discs")
    parts = [f"is H/(1 + H) at H = {_joined(_hursts(cases, HELD))} (the paper: above 0.4)"] if _any(cases, HELD) else []
    differences = [(case["difference"], hurst) for hurst, case in cases.items() if case["verdict"] == "not reproduced"]
    for sign, word in ((1, "larger"), (-1, "smaller")):
        named = [f"by {abs(d):.2f} at {hurst:g}" for d, hurst in reversed(differences) if d * sign > 0]
        parts += [f"{word} {_joined(named)}"] if named else []
    parts += [f"undecided at {_joined(_hursts(cases, ('undecided',)))}"] if _any(cases, ("undecided",)) else []
    return f"With boundary elements the exponent {_joined(parts, comma=True)}" if parts else ""


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
    apart = [f"by {abs(row.value):.2f} at {_hurst(row.case):g}" for row in rows[::-1].itertuples()]
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


def _capitalized(text):
    return text[:1].upper() + text[1:]
