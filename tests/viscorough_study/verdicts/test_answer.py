"""The answer in one paragraph: it follows the verdicts."""

import pandas as pd
import pytest

from viscorough_study.verdicts.answer import answer, short_answer

ROWS = [
    ("equivalence", "sphere", 1.0, 1.0, "reproduced"),
    ("collapse", "all H", 0.0, None, "reproduced"),
    ("beta", "H = 0.6", 0.393, 0.375, "reproduced under a stated convention"),
    ("beta", "H = 0.9", 0.466, 0.474, "reproduced"),
    ("beta_lines", "H = 0.41", 0.295, 0.291, "reproduced"),
    ("beta_lines", "H = 1", 0.501, 0.5, "reproduced"),
    ("exponent_small_hurst", "H = 0.1, discs", 0.16, 0.0, "not reproduced"),
    ("exponent_small_hurst", "H = 0.4, discs", 0.05, 0.0, "not reproduced"),
    ("exponent_small_hurst", "H = 0.1, lines", 0.04, 0.0, "not reproduced"),
    ("exponent_small_hurst", "H = 0.4, lines", 0.006, 0.0, "reproduced"),
    ("coincide", "H = 0.1", -0.124, 0.0, "not reproduced"),
    ("coincide", "H = 0.4", -0.045, 0.0, "undecided"),
    ("coincide", "H = 0.9", 0.008, 0.0, "reproduced"),
    ("coincide_equal_windows", "H = 0.1, same X", -0.08, 0.0, "not reproduced"),
    ("coincide_equal_windows", "H = 0.1, same κ", -0.07, 0.0, "not reproduced"),
    ("master_curve", "H = 0.4", 0.2, 0.0, "not reproduced"),
    ("one_constant", "H from 0.4 on, vt/h times 1.27", 0.056, 0.0, "reproduced"),
    ("one_constant", "H from 0.4 on, X times 1.86", 0.039, 0.0, "reproduced"),
    ("gamma", "sphere", 1.0, 1.11, "not reproduced"),
    ("complete_contact", "H = 0.1, slope within 0.05, from X = 10 on", 0.18, 1.0, "not reproduced"),
    ("complete_contact", "H = 0.9, slope within 0.05, from X = 7 on", 0.61, 1.0, "not reproduced"),
    ("complete_contact", "H = 0.1, slope within 0.01", None, 1.0, "undecided"),
    ("complete_contact", "H = 0.9, slope within 0.01, from X = 12 on", 0.78, 1.0, "not reproduced"),
]
TABLE = pd.DataFrame(ROWS, columns=["claim", "case", "value", "expected", "verdict"])


def test_answer_states_agreements_and_sizes_of_differences():
    assert answer(TABLE) == (
        "By direct integration the viscous problem is equivalent to the elastic problem, as the paper derives. "
        "The curves of each Hurst exponent collapse. By boundary elements on the paper's grid the exponent is within "
        "0.02 of H/(1 + H) at H = 0.6 and 0.9 (the paper: “at least for H > 0.4”), and larger by 0.05 at 0.4 and "
        "by 0.16 at 0.1. "
        "The method of dimensionality reduction (MDR) gives H/(1 + H) from 0.4 on; it differs from boundary elements "
        "by 0.12 at 0.1 (0.08 in equal ranges of X), where the paper sees them nearly coincide. From H = 0.4 "
        "on, Eq. 12 describes the discs in region (b) up to one constant, vt/h times 1.27 or X times 1.86. The factor "
        "1/Γ(2 − α) of Eqs. 7 to 9 does not follow from Eqs. 1, 3 and 6, and direct integration does not have it; it "
        "changes neither the exponent nor the collapse. Region (c), for the paper an almost complete contact, begins "
        "with fewer elements in contact: 18 to 61 % where the slope is 1 within 0.05 (H = 0.1 to 0.9) and 78 to 78 % "
        "where the slope is 1 within 0.01 (H = 0.9 to 0.9)."
    )


def test_answer_names_the_outcome_on_fine_grids():
    columns = ["claim", "case", "value", "expected", "verdict"]
    rows = [
        ("exponent_limit", "H = 0.1, X from 0.001 to 0.01", 0.16, 0.09, "undecided"),
        ("exponent_limit", "H = 0.4, X from 0.001 to 0.01", 0.3, 0.286, "reproduced"),
        ("exponent_limit", "H = 0.9, X from 0.0001 to 0.001", 0.48, 0.474, "reproduced"),
    ]
    text = answer(pd.concat([TABLE, pd.DataFrame(rows, columns=columns)], ignore_index=True))
    assert (
        "by 0.16 at 0.1. On finer grids and at smaller X it tends to H/(1 + H) at H = 0.4 and 0.9, and is undecided at "
        "H = 0.1. The method" in text
    )


@pytest.mark.parametrize(
    ("claim", "case", "verdict", "text"),
    [
        ("collapse", "all H", "undecided", "Whether the curves of each Hurst exponent collapse is undecided."),
        (
            "beta",
            "H = 0.6",
            "undecided",
            "is within 0.01 of H/(1 + H) at H = 0.9 (the paper: “at least for H > 0.4”), larger",
        ),
        ("beta", "H = 0.6", "undecided", ", and undecided at 0.6."),
        ("beta", "H = 0.9", "not reproduced", "and smaller by 0.01 at 0.9."),
        ("beta_lines", "H = 0.41", "undecided", "(MDR) gives H/(1 + H) from 1 on"),
        ("beta_lines", "H = 1", "undecided", "(MDR) differs from boundary elements by 0.12 at 0.1"),
        ("coincide", "H = 0.1", "undecided", "gives H/(1 + H) from 0.4 on. From H = 0.4 on, Eq. 12"),
        ("gamma", "sphere", "reproduced", "The factor 1/Γ(2 − α) of Eqs. 7 to 9 is confirmed."),
        ("gamma", "sphere", "undecided", "or X times 1.86. Region (c), for the paper"),
        ("equivalence", "sphere", "undecided", "The curves of each Hurst exponent collapse. By boundary"),
        ("master_curve", "H = 0.4", "reproduced", "Eq. 12 describes the curves in region (b). The factor"),
        ("one_constant", "H from 0.4 on, vt/h times 1.27", "undecided", "up to one constant, X times 1.86."),
    ],
)
def test_answer_changes_with_a_verdict(claim, case, verdict, text):
    changed = TABLE.copy()
    changed.loc[(changed["claim"] == claim) & (changed["case"] == case), "verdict"] = verdict
    assert text in answer(changed)


def test_short_answer_has_three_sentences_from_the_verdicts():
    assert short_answer(TABLE) == [
        "As the paper says, the viscous problem follows from the elastic one, and for each Hurst exponent H (small: "
        "rugged) the curves of all forces, viscosities, sizes and rms heights collapse onto one.",
        "In their middle part, vt/h is a power of time whose exponent is H/(1 + H) within 0.02 at H = 0.6 and 0.9 "
        "(the paper: “at least for H > 0.4”), and larger by 0.16 at H = 0.1 and by 0.05 at H = 0.4, where it claims "
        "nothing.",
        "Not reproduced: the prefactor of Eq. 12 and the factor 1/Γ(2 − α) of Eqs. 7 to 9; the exponent does not "
        "depend on them.",
    ]
    undecided = TABLE.assign(verdict="undecided")
    assert short_answer(undecided) == ["Whether the curves of each Hurst exponent collapse is undecided."]
