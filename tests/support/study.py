"""Ensembles that obey a law exactly, and the evidence and conventions that claims are judged by."""

from pathlib import Path

import numpy as np
import pandas as pd
import yaml

from viscorough import reference
from viscorough_study.ensembles import abscissa, combine, ensemble_dataset
from viscorough_study.gamma_factor import compare_direct
from viscorough_study.power_law import scaling_rows
from viscorough_study.verdicts import Evidence

SHOWN = {
    "average": "geometric",
    "rms_convention": "disc",
    "window_rule": "default",
    "gamma": "without",
    "diameter_convention": "diameter",
}
ROOT = Path(__file__).resolve().parents[2]
CLAIMS = yaml.safe_load((ROOT / "resources/paper/claims.yaml").read_text(encoding="utf-8"))
X = abscissa(1e-7, 30.0, 20)
HURST = (0.4, 0.6, 0.9)
LIMITS = {"elements_min": 10, "stiffness_max": 0.2, "slope_max": 0.8}


def ensemble(hurst, case, zeta, *, bent=0.0, scatter=0.02, seed=0, square=1.0):
    """Discs with κ = ζ X^α up to the complete contact, one element in contact at first; `square` scales κ there."""
    random = np.random.default_rng([seed, round(hurst * 1e6)])
    alpha = reference.exponent_alpha(hurst) + bent
    one = reference.one_element_stiffness(257)
    factor = np.exp(scatter * random.standard_normal((20, 1)))
    kappa = np.clip(zeta * factor * X**alpha, one, 1.0)
    stiffness = np.stack([kappa, np.clip(square * zeta * factor * X**alpha, one, 1.0)])
    count = np.where(stiffness > one, np.maximum(51433 * stiffness**2, 2.0), 1.0)
    return ensemble_dataset(
        ["disc", "square"], X, stiffness, count, {"hurst": hurst, "case": case, "diameter": 1.0, "elements": 51433}
    )


def evidence(zeta=reference.zeta_elastic, **options):
    discs = {hurst: [ensemble(hurst, f"c{i}", zeta(hurst), seed=i, **options) for i in range(4)] for hurst in HURST}
    lines = {
        hurst: each[0].sel(rms_convention=["disc"]).assign_coords(rms_convention=["line"])
        for hurst, each in discs.items()
    }
    how = {"resamples": 50, "seed": 1, "stiffness_range": [0.03, 0.3], **LIMITS}
    rows = []
    for hurst, each in discs.items():
        rows += scaling_rows(combine(each), source="discs", case_group="base", lines=lines[hurst], **how)
        rows += scaling_rows(lines[hurst], source="lines", case_group="base", **how)
    validation = pd.DataFrame(
        [("sphere_reduction", "depth", n, 1 / n**2) for n in (65, 129)],
        columns=["case", "quantity", "elements", "error"],
    )
    direct = compare_direct(HURST, 17, 1)
    about = {"shown": SHOWN, "across": 257, "limits": LIMITS, "resamples": 50, "seed": 1}
    return Evidence(discs, lines, pd.DataFrame(rows), validation, direct, **about)
