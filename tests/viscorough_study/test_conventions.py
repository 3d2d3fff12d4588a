"""Readings of the law: what follows from the plain reading equals a fit made in the other one."""

import numpy as np
import pandas as pd
import pytest
import yaml

from support.study import LIMITS, ROOT, SHOWN, ensemble_of, three_regions
from viscorough_study import conventions
from viscorough_study.conventions import in_every_reading, in_reading, interval_columns, readings, select, zeta_scale
from viscorough_study.ensembles import abscissa
from viscorough_study.figures.labels import CONVENTION_LABELS
from viscorough_study.fit_table import COLUMNS, fit_rows
from viscorough_study.power_law import fit_power_law

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


@pytest.mark.parametrize("reading", readings(), ids=lambda reading: "-".join(reading.values()))
def test_a_reading_is_a_fit_in_it(discs, table, reading):
    """ζ, its interval and the window against a fit on the abscissae of that reading."""
    x = X / conventions.LENGTH[reading["diameter_convention"]]
    row = in_reading(table, **reading).iloc[0]
    window = row["x_low"], row["x_high"]
    fit = fit_power_law(x, discs["velocity"].values[0], window, average=row["average"], **BOOTSTRAP)
    expected = fit.zeta(gamma=reading["gamma"])  # with the diameter: the abscissae already are those of the reading
    assert row[["zeta", "zeta_low", "zeta_high"]].tolist() == pytest.approx(expected, rel=1e-12)
    assert (row["beta"], row["decades"]) == pytest.approx((fit.beta, np.log10(window[1] / window[0])), rel=1e-12)


def test_intervals_of_other_readings_do_not_follow_from_the_plain_one(table):
    """Their ends are percentiles of samples scaled one by one, which is why they are stored."""
    row = table.iloc[0]
    low, _ = interval_columns(gamma="without", diameter_convention="radius")
    assert row[low] != pytest.approx(row["zeta_low"] * 2 ** row["beta"], rel=1e-6)


def test_every_reading_of_every_fit_once(table):
    every = in_every_reading(table)
    assert len(every) == 4 * len(table)
    assert not every.duplicated(["case_group", *conventions.NAMES]).any()
    assert (every.groupby(["case_group", *conventions.FITTED], sort=False)["beta"].nunique() == 1).all()
    assert every["average"].tolist() == np.repeat(table["average"], 4).tolist()
    assert set(every) == (set(COLUMNS) - {n for r in readings()[1:] for n in interval_columns(**r)}) | set(
        conventions.READINGS
    )


def test_select_is_one_row_for_each_ensemble(table):
    reading = {"gamma": "with", "diameter_convention": "radius"}
    wanted = SHOWN | reading | {"case_group": "corners"}
    (row,) = select(table, wanted).to_dict("records")
    assert {name: row[name] for name in wanted} == wanted
    plain = select(table, SHOWN | {"case_group": "corners"}).iloc[0]
    assert row["zeta"] == pytest.approx(plain["zeta"] * zeta_scale(plain["beta"], **reading))
    assert row["x_low"] == 2 * plain["x_low"]


def test_twice_the_force_is_like_the_radius(discs, table):
    """F/G twice as large: X and κ are, and vt/h stays."""
    row = in_reading(table, gamma="without", diameter_convention="radius").iloc[0]
    velocity, window = discs["velocity"].values[0], (row["x_low"], row["x_high"])
    scaled = fit_power_law(2 * X, velocity, window, average=row["average"], **BOOTSTRAP)
    assert row["zeta"] == pytest.approx(scaled.zeta()[0], rel=1e-12)


def test_the_radius_is_not_left_open(table):
    every = in_every_reading(table)
    chosen = conventions.left_open(every)
    assert len(chosen) == len(every) / 2
    assert set(chosen["diameter_convention"]) == {"diameter"}
    assert set(chosen["gamma"]) == {"with", "without"}


@pytest.mark.parametrize("wrong", [{"gamma": True}, {"diameter_convention": "width"}])
def test_unknown_readings_are_refused(wrong):
    with pytest.raises(ValueError, match=f"{next(iter(wrong))}: must be one of"):
        zeta_scale(0.4, **(conventions.PLAIN | wrong))


def test_settings_and_figures_know_the_same_values():
    schema = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text(encoding="utf-8"))
    figures = schema["properties"]["figures"]["properties"]
    for name, values in conventions.VALUES.items():
        assert sorted(figures[name]["enum"]) == sorted(CONVENTION_LABELS[name]) == sorted(values)
