"""The answer in one paragraph: it follows the verdicts."""

import pandas as pd
import pytest

from viscorough_study.verdicts.answer import answer

ROWS = [
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
    ("zeta_elastic", "H = 0.1", 1.2, 0.9, "not reproduced"),
    ("zeta_viscous", "H = 0.1", 1.3, 1.9, "not reproduced"),
    ("gamma", "sphere", 1.0, 1.11, "not reproduced"),
    ("complete_contact", "H = 0.1", 0.2, 1.0, "not reproduced"),
]
TABLE = pd.DataFrame(ROWS, columns=["claim", "case", "value", "expected", "verdict"])


def test_answer_states_agreements_and_sizes_of_differences():
    assert answer(TABLE) == (
        "The curves of each Hurst exponent collapse. With boundary elements the exponent is H/(1 + H) at H = 0.6 and "
        "0.9 (the paper: above 0.4), and larger by 0.05 at 0.4 and by 0.16 at 0.1. The method of dimensionality "
        "reduction (MDR) gives H/(1 + H) from 0.4 on; it differs from boundary elements by 0.12 at 0.1, where the "
        "paper sees them nearly coincide. The prefactors differ from the paper's, the factor 1/Γ(2 − α) is an error "
        "and region (c) begins far before complete contact."
    )


@pytest.mark.parametrize(
    ("claim", "case", "verdict", "text"),
    [
        ("collapse", "all H", "undecided", "Whether the curves of each Hurst exponent collapse is undecided."),
        ("beta", "H = 0.6", "undecided", "is H/(1 + H) at H = 0.9 (the paper: above 0.4), larger by"),
        ("beta", "H = 0.6", "undecided", ", and undecided at 0.6."),
        ("beta", "H = 0.9", "not reproduced", "and smaller by 0.01 at 0.9."),
        ("beta_lines", "H = 0.41", "undecided", "(MDR) gives H/(1 + H) from 1 on"),
        ("beta_lines", "H = 1", "undecided", "(MDR) differs from boundary elements by 0.12 at 0.1"),
        ("coincide", "H = 0.1", "undecided", "gives H/(1 + H) from 0.4 on. The prefactors differ from the paper's"),
        ("gamma", "sphere", "reproduced", "the factor 1/Γ(2 − α) is confirmed"),
        ("gamma", "sphere", "undecided", "The prefactors differ from the paper's and region (c) begins far"),
        ("zeta_viscous", "H = 0.1", "reproduced", "nearly coincide. The factor 1/Γ(2 − α) is an error"),
    ],
)
def test_answer_changes_with_a_verdict(claim, case, verdict, text):
    changed = TABLE.copy()
    changed.loc[(changed["claim"] == claim) & (changed["case"] == case), "verdict"] = verdict
    assert text in answer(changed)
