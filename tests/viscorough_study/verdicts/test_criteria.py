"""Criteria: their statistics against known distributions, and their limits."""

import dataclasses
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from scipy import stats
from scipy.special import gamma as gamma_function

from support.study import ACROSS, CLAIMS, ELEMENTS, HURST, X, evidence, evidence_of_curves, evidence_with_factors
from viscorough.reference import exponent_alpha, exponent_beta, one_element_stiffness, zeta_elastic
from viscorough_study.fits.intervals import three_columns
from viscorough_study.verdicts.claims import JUDGES
from viscorough_study.verdicts.evidence import judged
from viscorough_study.verdicts.law_criteria import (
    alpha_limit,
    depth,
    exponent_limit,
    exponent_small_hurst,
    master_curve,
    no_grid,
    realizations,
)
from viscorough_study.verdicts.method_criteria import bodies_of_revolution, contact_problems, elements
from viscorough_study.verdicts.region_criteria import (
    complete_contact,
    complete_contact_end,
    excess_variance,
    last_region,
    power_law,
    power_law_control,
    power_law_decades,
    separation,
)


@pytest.fixture
def sample():
    return evidence()


def test_interval_of_the_variance_between_groups_has_its_stated_coverage():
    """In 1000 draws, each end of the 95 % interval misses the true ratio of variances in 2.5 %, the median in half.

    The counts must lie in the 99.99 % range of the binomial distribution: 8 to 47 of 1000 for the ends. The groups
    scatter so much that the smallest allowed upper end has no effect.
    """
    random, draws, between, within = np.random.default_rng(7), 1000, 2.0, 2.0
    beyond = np.zeros(3)
    for _ in range(draws):
        means = np.sqrt(between) * random.standard_normal(6)
        groups = means[:, None] + np.sqrt(within) * random.standard_normal((6, 8))
        median, low, high, sampling = excess_variance([list(groups)])
        truth = between / (within / 8) * sampling
        beyond += median > truth, low > truth, high < truth
    for count, share in zip(beyond, (0.5, 0.025, 0.025), strict=True):
        fewest, most = stats.binom.interval(0.9999, draws, share)
        assert fewest <= count <= most


def test_variance_between_groups_is_never_negative_and_needs_two_groups():
    same = [np.array([0.0, 1.0, np.nan])] * 3
    median, low, high, sampling = excess_variance([same])
    assert (median, low) == (0, 0)
    assert high == pytest.approx((1 / stats.f.ppf(0.025, 2, 3) - 1) * sampling), "as if they scattered by chance"
    assert np.isnan([excess_variance([same[:1]]), excess_variance([[np.zeros(1)] * 4])]).all()


def test_variance_between_groups_excludes_the_variance_between_sets():
    """Four sets narrow the interval as much as 32 and 284 degrees of freedom, instead of 8 and 71 for one set."""
    groups = np.random.default_rng(5).standard_normal((4, 9, 80))
    apart = excess_variance([list(group + 10 * i) for i, group in enumerate(groups)])
    np.testing.assert_allclose(apart, excess_variance([list(group) for group in groups]), rtol=1e-9)
    assert apart[2] < 0.5 * np.mean([excess_variance([list(group)])[2] for group in groups])


def test_variance_between_groups_takes_a_degree_of_freedom_from_every_set():
    """Two sets of two groups of two samples: 4 − 2 and 4 degrees of freedom, and mean squares 80/2 and 8/4."""
    sets = [[mean + np.array([-1.0, 1.0]) for mean in means] for means in ((0.0, 4.0), (10.0, 18.0))]
    median, low, high, sampling = excess_variance(sets)
    assert sampling == pytest.approx(2 / 2)
    assert (median, low, high) == pytest.approx(tuple(20 / stats.f.ppf([0.5, 0.975, 0.025], 2, 4) - 1))


def test_verdict_depends_on_the_numbers_of_cases_and_realizations():
    """For four cases, 1.05 to 1.35 lies outside of -1 to 1 (outside begins at 1.01); for fifty cases at 0.95."""
    sample, values = evidence(), (1.2, 1.05, 1.35)
    assert sample.within(values, -1.0, 1.0, realizations=80, cases=4) is False
    assert sample.within(values, -1.0, 1.0, realizations=80, cases=50) is None
    assert sample.within(values, -1.0, 1.0, realizations=79) is None
    assert sample.within(values, -1.0, 1.5, realizations=80, cases=50) is True, "all cases must hold, each by itself"
    assert sample.within(values, -1.0, 1.5, realizations=79) is None
    for half, inside, outside in ((0.049, True, False), (0.051, None, None)):  # twenty times as wide: 0.98 and 1.02
        assert sample.within((0.0, -half, half), -1.0, 1.0, realizations=79) is inside
        assert sample.within((2.0, 2.0 - half, 2.0 + half), -1.0, 1.0, realizations=79) is outside


def test_claims_on_ensembles_of_few_realizations_are_undecided():
    """The evidence has 40 discs for every Hurst exponent; with 80 discs it decides."""
    many, few = evidence(scatter=0.1), evidence(scatter=0.1)
    for name in ("scaling", "plateaus", "zeta_laws"):
        few.tables[name]["realizations"] = 40
    first = few.discs["case"].isin(["c0", "c1"]).values
    few = dataclasses.replace(few, discs=few.discs.isel(realization=np.flatnonzero(first)))
    for name in ("zeta_elastic", "separation", "collapse", "power_law", "power_law_decades"):
        tolerance = CLAIMS[name]["tolerance"]
        assert "undecided" not in {case["verdict"] for case in JUDGES[name](many, tolerance)}, name
        assert {case["verdict"] for case in JUDGES[name](few, tolerance)} == {"undecided"}, name


def test_convention_counts_only_for_cases_with_a_value():
    undecided, undefined = (judged("a", (value, 0.9, 1.1), 1.0, None, "square") for value in (1.0, np.nan))
    assert (undecided["verdict"], undecided["convention"]) == ("reproduced under a stated convention", "square")
    assert (undefined["verdict"], undefined["convention"]) == ("undecided", "")


def test_all_errors_of_bodies_of_revolution_must_meet_the_tolerance(sample):
    """The errors of the stiffness are included. The finest grid decides."""
    rows = [("depth", 65, 1e-2), ("depth", 129, 1e-5), ("stiffness", 65, 3e-2), ("stiffness", 129, 3e-3)]
    validation = pd.DataFrame(rows, columns=["quantity", "elements", "error"]).assign(case="cone_reduction")
    sample.tables["validation"] = validation
    for tolerance, verdicts in ((5e-3, ["reproduced"] * 2), (1e-3, ["reproduced", "not reproduced"])):
        cases = list(bodies_of_revolution(sample, tolerance))
        assert [case["verdict"] for case in cases] == verdicts
        assert [(case["value"], case["least"], case["largest"]) for case in cases] == [
            (1e-5, 1e-5, 1e-2),
            (3e-3, 3e-3, 3e-2),
        ]


def test_four_elements_lie_on_the_rim_of_the_disc():
    (case,), (missed,) = (elements(evidence(), tolerance) for tolerance in (4, 0))
    assert (case["value"], case["least"], case["largest"]) == (51433, 51429, 51433)
    assert (case["verdict"], missed["verdict"]) == ("reproduced", "not reproduced")


def test_settings_decide_how_long_a_power_law_must_be(sample):
    """The intervals are 2.2 to 2.6 decades."""
    for decades, verdict in ((2.2, "reproduced"), (2.3, "undecided"), (2.7, "not reproduced")):
        changed = dataclasses.replace(sample, rules=sample.rules | {"decades_min": decades})
        assert {case["verdict"] for case in power_law_decades(changed, 0.05)} == {verdict}
    changed.tables["plateaus"]["power_law_fails"] = 0.1
    assert {case["verdict"] for case in power_law_decades(changed, 0.05)} == {"undecided"}, "the test loses power laws"


def test_spread_of_slopes_decides_for_discs_and_for_the_control(sample):
    """The intervals are 0.01 to 0.03. The control has no power law, so it should not pass."""
    control = sample.tables["plateaus"].assign(case_group="roll_off")
    sample.tables["plateaus"] = pd.concat([sample.tables["plateaus"], control], ignore_index=True)
    for tolerance, near, told in ((0.05, "reproduced", "not reproduced"), (0.02, *["undecided"] * 2)):
        assert {case["verdict"] for case in power_law(sample, tolerance)} == {near}
        assert {case["verdict"] for case in power_law_control(sample, tolerance)} == {told}
    assert len(list(power_law_control(sample, 0.05))) == len(HURST)


def test_lines_belong_to_the_master_curve(sample):
    """Lines that equal the discs deviate alike from Eq. 12; halving their ζ adds ln 2."""
    discs, lines = np.split(np.array(list(master_curve(sample, 0.15))), 2)
    for disc, line in zip(discs, lines, strict=True):
        assert line["case"] == f"{disc['case']}, lines"
        assert line["value"] == pytest.approx(disc["value"], rel=0.02)
        assert line["low"] < line["value"] < line["high"]
    scaling = sample.tables["scaling"]
    rows = scaling["source"] == "lines"
    scaling.loc[rows, ["zeta_fixed", "zeta_fixed_low", "zeta_fixed_high"]] /= 2
    halved = list(master_curve(sample, 0.15))[len(discs) :]
    added = [after["value"] - before["value"] for before, after in zip(lines, halved, strict=True)]
    assert added == pytest.approx([np.log(2)] * len(added), abs=0.01)


def test_deviation_from_the_master_curve_includes_the_residual(sample):
    """Lines with the prefactor of Eq. 12 and a residual of 0.2 deviate by 0.2."""
    scaling = sample.tables["scaling"]
    hurst = scaling["hurst"]
    law = (2 - hurst) * gamma_function(1 + exponent_beta(hurst))
    for name, factor in (("zeta_fixed", 1.0), ("zeta_fixed_low", 0.99), ("zeta_fixed_high", 1.01)):
        scaling[name] = factor * law
    for residual, verdict in ((0.2, "not reproduced"), (0.1, "reproduced")):
        scaling["residual_fixed"] = residual
        for case in master_curve(sample, 0.15):
            assert (case["value"], case["low"]) == pytest.approx((residual, residual), abs=1e-6)
            assert case["verdict"] == verdict


def test_exponents_up_to_the_limit_of_the_claim_are_shown_apart(sample):
    """Of H = 0.4, 0.6 and 0.9, the paper claims H/(1 + H) only above 0.4."""
    assert [case["case"] for case in exponent_small_hurst(sample, 0.03)] == ["H = 0.4, discs", "H = 0.4, lines"]
    scaling = sample.tables["scaling"]
    first = (scaling["source"] == "discs") & (scaling["hurst"] == 0.4)
    scaling.loc[first, ["beta", "beta_low", "beta_high"]] = 0.4 / 1.4 + np.array([0.05, 0.045, 0.055])
    discs, lines = exponent_small_hurst(sample, 0.03)
    assert (discs["value"], discs["verdict"]) == (pytest.approx(0.05), "not reproduced")
    assert lines["verdict"] == "reproduced"


def test_exponent_on_fine_grids_is_its_limit_or_that_of_the_finest_grid(sample):
    """An open limit is undecided."""
    columns = ["hurst", "quantity", "judged", "x_low", "finding", "expected", *three_columns("beta", range(3))]
    rows = [
        (0.4, "whole", 1, 1e-3, "within", 0.286, 0.31, 0.30, 0.32, 0.29, 0.28, 0.30),
        (0.1, "whole", 1, 1e-3, "open", 0.091, 0.16, 0.1, 0.22, -0.1, -0.5, 0.3),
        (0.9, "whole", 1, 1e-4, "outside", 0.474, 0.6, 0.59, 0.61, 0.6, 0.59, 0.61),
    ]
    table = pd.DataFrame(rows, columns=[*columns, *three_columns("limit", range(3))])
    sample.tables["fine_exponents"] = table
    cases = list(exponent_limit(sample, 0.03))
    assert [case["case"].split(",")[0] for case in cases] == ["H = 0.4", "H = 0.1", "H = 0.9"]
    assert [(case["value"], case["low"]) for case in cases] == [(0.29, 0.28), (0.16, 0.1), (0.6, 0.59)]
    assert [case["verdict"] for case in cases] == ["reproduced", "undecided", "not reproduced"]
    del sample.tables["fine_exponents"]
    assert [case["verdict"] for case in exponent_limit(sample, 0.03)] == ["undecided"]


def test_curves_that_leave_the_first_region_sooner_separate_first(sample):
    """κ = ζ X^α is twice π/(K₀₀ n) at X = (2π/(K₀₀ n ζ))^(1/α)."""
    end = {hurst: (2 * one_element_stiffness(ACROSS) / zeta_elastic(hurst)) ** (1 + hurst) for hurst in HURST}
    cases = separation(sample, 0.0)
    for case, (lower, higher) in zip(cases, pairwise(HURST), strict=True):
        assert case["value"] == pytest.approx(end[lower] / end[higher], rel=0.1)
        assert case["low"] < case["value"] < case["high"]
        assert case["verdict"] == "reproduced"


def test_interval_of_the_separation_assumes_independent_ensembles():
    """ln X at the end of region (a) scatters by 1/α of ln κ. The variances of both Hurst exponents add up."""
    sample = dataclasses.replace(evidence_with_factors(0.2), resamples=1000)
    error = stats.t.ppf(0.975, 79) * 0.2 / np.sqrt(80)
    for case, pair in zip(separation(sample, 0.0), pairwise(HURST), strict=True):
        expected = error * np.hypot(*(1 / exponent_alpha(hurst) for hurst in pair))
        assert np.log(case["high"] / case["low"]) / 2 == pytest.approx(expected, rel=0.1)


def test_contact_is_complete_only_if_most_elements_touch(sample):
    """The contact fraction of these discs is κ², so it is 1 where κ is 1."""
    assert {case["verdict"] for case in complete_contact(sample, 0.1)} == {"reproduced"}
    halved = sample.discs.assign(contact_count=sample.discs["contact_count"] / 2)
    cases = list(complete_contact(dataclasses.replace(sample, discs=halved), 0.1))
    assert {case["verdict"] for case in cases} == {"not reproduced"}
    assert all(case["value"] == pytest.approx(0.5, abs=0.01) for case in cases)


def test_contact_at_the_end_of_the_curves_is_judged_separately(sample):
    """Elements still join after the slope has become 1: a fraction of 0.5 touches there, and 0.95 at the end."""
    start = {case["case"].split(", ")[0]: case["value"] for case in complete_contact(sample, 0.1)}
    late = xr.where(sample.discs["x"] > 20, 0.95, 0.5)
    discs = sample.discs.assign(contact_count=sample.discs["contact_count"] * late)
    changed = dataclasses.replace(sample, discs=discs)
    assert {case["verdict"] for case in complete_contact(changed, 0.1)} == {"not reproduced"}
    cases = list(complete_contact_end(changed, 0.1))
    assert [case["case"] for case in cases] == [f"{hurst}, at X = 28.2" for hurst in start]
    assert all(case["value"] == pytest.approx(0.95, abs=0.01) for case in cases)
    assert {case["verdict"] for case in cases} == {"reproduced"}


@pytest.mark.parametrize("number", [0, 1])
def test_region_c_of_curves_that_end_early_is_undecided(sample, number):
    reached = np.arange(sample.discs.sizes["abscissa"]) < number
    early = dataclasses.replace(sample, discs=sample.discs.where(xr.DataArray(reached, dims="abscissa")))
    cases = [*last_region(early, 0.05), *complete_contact(early, 0.1)]
    cases += complete_contact_end(early, 0.1) if number == 0 else []
    assert {case["verdict"] for case in cases} == {"undecided"}


def test_change_of_stiffness_with_the_grid_is_judged_at_given_depths(sample):
    """The comparison is not at given forces, and only over grids with enough elements in contact."""
    cases = list(no_grid(sample, 0.12))
    assert [case["verdict"] for case in cases] == ["not reproduced", "undecided", "reproduced"]
    assert [(case["least"], case["largest"]) for case in cases] == [(0.2, 0.3)] * 3
    sample.tables["grid_dependence"] = sample.tables["grid_dependence"].query("compared == 0")
    assert [case["verdict"] for case in no_grid(sample, 0.12)] == ["undecided"]


def test_interval_of_the_exponent_from_250_indentations():
    sample = evidence(scatter=0.0)
    random = np.random.default_rng(5).standard_normal(sample.discs.sizes["realization"])
    exponent = xr.DataArray(0.1 * random, dims="realization")
    sample.discs["stiffness"] = sample.discs["stiffness"] * sample.discs["x"] ** exponent
    for case in realizations(sample, 0.03):
        assert case["low"] < 1.96 * 0.1 / np.sqrt(250) < case["high"]
        probabilities = [stats.chi2.cdf(79 * (case["value"] / end) ** 2, 79) for end in (case["low"], case["high"])]
        assert probabilities == pytest.approx([0.975, 0.025]), "the distribution of a variance of 80 samples"
        assert case["verdict"] == "reproduced"
    assert {case["verdict"] for case in realizations(sample, 0.001)} == {"not reproduced"}


def test_limit_of_the_exponent_needs_lines_and_discs_of_that_exponent(sample):
    assert [case["verdict"] for case in alpha_limit(sample, 0.015)] == ["undecided", "undecided"]
    for number, (table, source) in enumerate((("scaling", "lines"), ("sizes", "discs"))):
        known = sample.tables[table]
        rows = known[(known["source"] == source) & (known["hurst"] == 0.9)].assign(hurst=1.0, beta=0.5)
        for half_width, verdict in ((0.01, "reproduced"), (0.02, "undecided")):
            more = rows.assign(beta_low=0.5 - half_width, beta_high=0.5 + half_width)
            sample.tables[table] = pd.concat([known, more], ignore_index=True)
            assert [case["verdict"] for case in alpha_limit(sample, 0.015)][number] == verdict
    others = [more.assign(elements=more["elements"] * of, beta=0.1) for of in (0.25, 4)]
    sample.tables["sizes"] = pd.concat([*others, more], ignore_index=True)
    assert [case["value"] for case in alpha_limit(sample, 0.015)][1] == 0.5


def test_contact_problems_are_changes_of_the_contact_and_explicit_steps(sample):
    """Every disc is in complete contact at the end. 256 is the smallest number of steps with an error below 1 %."""
    changes, steps = contact_problems(sample, 1e7)
    assert (changes["value"], changes["verdict"]) == (ELEMENTS, "reproduced")
    assert (steps["value"], steps["verdict"]) == (256, "reproduced")
    assert [case["verdict"] for case in contact_problems(sample, 1e4)] == ["not reproduced", "reproduced"]
    sample.tables["methods"].loc[sample.tables["methods"]["steps"] == 256, "steps"] = 99.0
    assert [case["verdict"] for case in contact_problems(sample, 1e7)] == ["reproduced", "not reproduced"]
    sample.tables["methods"] = sample.tables["methods"].query("method == 'MDR'")
    assert [case["verdict"] for case in contact_problems(sample, 1e7)] == ["reproduced", "undecided"]


def test_slope_and_prefactor_of_the_last_region_follow_the_curve():
    """A parabola of ln(vt/h) over ln X has a least-squares slope equal to its slope in the middle of the five steps."""
    log_x = np.log(X)
    stiffness = np.tile(X / np.exp(0.2 + 0.7 * log_x + 0.05 * log_x**2), (3, 1))
    sample = dataclasses.replace(evidence_of_curves(stiffness, stiffness), rules={"end_decades": 0.26})
    slope = 0.7 + 0.1 * log_x[[-6, -1]].mean()
    assert [case["value"] for case in last_region(sample, 0.05)] == pytest.approx([stiffness[0, -1], slope], rel=1e-9)


def test_interval_of_the_depth_contains_the_scatter_of_the_exponent():
    """For power laws with exponents β_i the ratio is ⟨β⟩⟨1/β⟩, which is known far better than ⟨1/β⟩ for a given ⟨β⟩.

    The ratio is close to 1 for every draw of discs. An interval with a fixed exponent would be several times wider.
    """
    exponents = 0.4 * np.exp(0.2 * np.random.default_rng(4).standard_normal((60, 1)))
    stiffness = 0.5 * X ** (1 - exponents)
    count = np.where(X < 1e-3, 2, 20) * np.ones_like(stiffness)  # region (b) begins far from the first abscissa
    (case,) = depth(evidence_of_curves(stiffness, count), 0.1)
    assert case["value"] == pytest.approx(exponents.mean() * (1 / exponents).mean(), rel=0.015)
    with_fixed_exponent = 2 * 1.96 * 0.2 / np.sqrt(60)
    assert 0 < case["high"] - case["low"] < with_fixed_exponent / 2
