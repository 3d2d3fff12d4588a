"""Readings of the law: what follows from the plain reading equals a fit made in the other one."""

import numpy as np
import pandas as pd
import pytest
import yaml

from support.study import LIMITS, ROOT, SHOWN, ensemble_of, three_regions
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.figures.conventions import CONVENTION_LABELS
from viscorough_study.fits import conventions
from viscorough_study.fits.conventions import GAMMA, in_reading, select, zeta_scale
from viscorough_study.fits.fit_table import COLUMNS, fit_rows
from viscorough_study.fits.power_law import fit_power_law

X = abscissa(1e-7, 10, 20)
BOOTSTRAP = {"resamples": 100, "seed": 1}


@pytest.fixture(scope="module")
def discs():
    return ensemble_of(X, three_regions(X) * np.exp(0.2 * np.random.default_rng(9).normal(size=(8, X.size))))


@pytest.fixture(scope="module")
def table(discs):
    limits = {**LIMITS, "stiffness_range": (0.03, 0.3)}
    rows = []
    for group in ("base", "corners"):
        rows += fit_rows(discs, source="discs", case_group=group, **BOOTSTRAP, **limits)
    return pd.DataFrame(rows, columns=list(COLUMNS))


@pytest.mark.parametrize("gamma", GAMMA)
def test_a_reading_is_a_fit_in_it(discs, table, gamma):
    """ζ and its interval against a fit in that reading."""
    row = in_reading(table, gamma).iloc[0]
    window = row["x_low"], row["x_high"]
    fit = fit_power_law(X, discs["velocity"].values[0], window, average=row["average"], **BOOTSTRAP)
    assert row[["zeta", "zeta_low", "zeta_high"]].tolist() == pytest.approx(fit.zeta(gamma), rel=1e-12)
    assert (row["beta"], row["decades"]) == pytest.approx((fit.beta, np.log10(window[1] / window[0])), rel=1e-12)


def test_select_is_one_row_for_each_ensemble(table):
    wanted = SHOWN | {"gamma": "with", "case_group": "corners"}
    (row,) = select(table, wanted).to_dict("records")
    assert {name: row[name] for name in wanted} == wanted


def test_unknown_readings_are_refused():
    with pytest.raises(ValueError, match="gamma: must be one of"):
        zeta_scale(0.4, "half")


def test_settings_and_figures_know_the_same_values():
    schema = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text(encoding="utf-8"))
    figures = schema["properties"]["figures"]["properties"]
    for name, values in conventions.VALUES.items():
        assert sorted(figures[name]["enum"]) == sorted(CONVENTION_LABELS[name]) == sorted(values)
