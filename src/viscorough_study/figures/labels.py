"""Labels of the conventions that the paper leaves open, {column of the scaling table: {value: label}}."""

CONVENTION_LABELS = {
    "average": {"arithmetic": "arithmetic mean", "geometric": "geometric mean"},
    "rms_convention": {
        "disc": "$h$ of the disc",
        "square": "$h$ of the square",
        "peak": "$h$ of the highest peak",
        "ensemble": "$h$ of the ensemble",
    },
    "window_rule": {
        "default": "whole window",
        "lower_half": "lower half of window",
        "upper_half": "upper half of window",
        "kappa": "window of given κ",
    },
    "gamma": {"without": "law without Γ", "with": "law with Γ (Eq. 9)"},
}
