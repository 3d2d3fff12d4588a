"""Criteria: their statistics against known distributions, and their limits."""

import dataclasses
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from scipy import stats
from scipy.special import gamma as gamma_function

from support.study import ACROSS, HURST, X, evidence, evidence_of_curves, evidence_with_factors
from viscorough.reference import exponent_alpha, exponent_beta, one_element_stiffness, zeta_elastic
from viscorough_study.verdicts import curves, exponents, lines, prefactors
from viscorough_study.verdicts.curves import excess_variance
from viscorough_study.verdicts.evidence import judged


def judge(claim, sample):
    """Return the cases of a claim by some evidence."""
    return list(claim.judge(sample, claim.tolerance))


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
    for name in ("scaling", "local_slope", "zeta_laws"):
        few.tables[name]["realizations"] = 40
    first = few.discs["ensemble"].isin(["c0", "c1"]).values
    few = dataclasses.replace(few, discs=few.discs.isel(realization=np.flatnonzero(first)))
    for claim in (prefactors.zeta_elastic, curves.separation, curves.collapse, curves.power_law):
        assert "undecided" not in {case["verdict"] for case in judge(claim, many)}, claim.name
        assert {case["verdict"] for case in judge(claim, few)} == {"undecided"}, claim.name


def test_case_without_a_value_is_undecided():
    assert judged("a", (np.nan, 0.9, 1.1), 1.0, True)["verdict"] == "undecided"
    assert judged("a", (1.0, 0.9, 1.1), 1.0, False)["verdict"] == "not"


def test_spread_of_slopes_decides_for_discs_and_for_the_control(sample):
    """The intervals are 0.01 to 0.03. The control has no power law, so the test should reject it."""
    control = sample.tables["local_slope"].query("group == 'base'").assign(group="roll_off")
    sample.tables["local_slope"] = pd.concat([sample.tables["local_slope"], control], ignore_index=True)
    for tolerance, near, told in ((0.05, "holds", "not"), (0.02, *["undecided"] * 2)):
        assert {case["verdict"] for case in curves.power_law.judge(sample, tolerance)} == {near}
        cases = list(curves.power_law_control.judge(sample, tolerance))
        assert [case["verdict"] for case in cases] == [told] * len(HURST)


def test_lambda_moves_the_prefactor_of_lines(sample):
    """With λ = π 2^(2/α) the heights of a line are 2^(1/α) times as large, and ζ is half as large."""
    scaling = sample.tables["scaling"]
    before = judge(lines.line_master_curve, sample)
    discs = scaling["source"] == "discs"
    scaling.loc[discs, "lambda"] = np.pi * 2 ** (2 / exponent_alpha(scaling.loc[discs, "hurst"]))
    after = judge(lines.line_master_curve, sample)
    assert [case["case"] for case in after] == [f"H = {hurst}, {name}" for name in ("λ = π", "λ(H)") for hurst in HURST]
    moved = [case["value"] - old["value"] for case, old in zip(after, before, strict=True)]
    assert moved == pytest.approx([0] * len(HURST) + [np.log(2)] * len(HURST), abs=0.01)


def test_deviation_from_equation_12_has_two_parts(sample):
    """A fit with the prefactor of Eq. 12 and a residual of 0.2 deviates by 0.2."""
    scaling = sample.tables["scaling"]
    names = ["zeta_fixed", "zeta_fixed_low", "zeta_fixed_high"]
    law = (2 - scaling["hurst"]) * gamma_function(1 + exponent_beta(scaling["hurst"]))
    for name, factor in zip(names, (1.0, 0.99, 1.01), strict=True):
        scaling[name] = factor * law
    for residual, verdict in ((0.2, "not"), (0.1, "holds")):
        scaling["residual_fixed"] = residual
        for case in judge(prefactors.master_curve, sample):
            assert (case["value"], case["low"]) == pytest.approx((residual, residual), abs=1e-6)
            assert (case["verdict"], case["note"].split(",")[0]) == (verdict, "ζ/(2 − H) = 1.00")


def test_exponents_up_to_the_limit_of_the_claim_are_judged_apart(sample):
    """Of H = 0.4, 0.6 and 0.9, the paper claims H/(1 + H) only above 0.4."""
    assert [case["case"] for case in judge(exponents.beta, sample)] == ["H = 0.6", "H = 0.9"]
    scaling = sample.tables["scaling"]
    first = (scaling["source"] == "discs") & (scaling["hurst"] == 0.4)
    scaling.loc[first, ["beta", "beta_low", "beta_high"]] = 0.4 / 1.4 + np.array([0.05, 0.045, 0.055])
    (case,) = judge(exponents.exponent_small_hurst, sample)
    assert (case["case"], case["value"] - case["expected"]) == ("H = 0.4", pytest.approx(0.05))
    assert case["verdict"] == "not"


def test_limit_of_fine_grids_is_judged_from_the_paper_s_range_on(sample):
    """An open limit is undecided, with the value on the finest grid; H = 0.1 is out of the range of Eq. 5."""
    table = sample.tables["fine_exponents"]
    (case,) = judge(exponents.exponent_limit, sample)
    assert (case["case"], case["value"], case["verdict"]) == ("H = 0.4", 0.29, "holds")
    sample.tables["fine_exponents"] = table.assign(finding="open")
    (case,) = judge(exponents.exponent_limit, sample)
    assert (case["value"], case["verdict"]) == (0.3, "undecided")
    sample.tables["fine_exponents"] = table.assign(finding="outside")
    assert [case["verdict"] for case in judge(exponents.exponent_limit, sample)] == ["not"]


def test_exact_exponent_is_judged_on_lines_and_on_fine_discs(sample):
    assert [case["verdict"] for case in judge(lines.alpha_limit, sample)] == ["undecided"]
    known, fine = sample.tables["scaling"], sample.tables["fine_exponents"]
    rows = known[(known["source"] == "lines") & (known["hurst"] == 0.9)].assign(hurst=1.0, beta=0.5)
    discs = fine[fine["hurst"] == 0.4].assign(hurst=1.0, limit=0.5)
    for half_width, verdict in ((0.01, "holds"), (0.02, "undecided")):
        low, high = 0.5 - half_width, 0.5 + half_width
        lines_added = rows.assign(beta_low=low, beta_high=high)
        sample.tables["scaling"] = pd.concat([known, lines_added], ignore_index=True)
        sample.tables["fine_exponents"] = pd.concat([fine, discs.assign(limit_low=low, limit_high=high)])
        cases = [(case["case"], case["verdict"]) for case in judge(lines.alpha_limit, sample)]
        assert cases == [("lines", verdict), ("discs", verdict)]


def test_exponents_of_both_methods_are_compared_in_their_own_regions(sample):
    table = sample.tables["mdr_exponents"]
    moved = table["hurst"] == 0.6
    table.loc[moved, ["difference", "difference_low", "difference_high"]] += 0.1
    sample.tables["mdr_exponents"] = pd.concat([table, table.assign(window="same X", difference=1.0)])
    cases = [(case["case"], case["verdict"]) for case in judge(lines.coincide, sample)]
    assert cases == [("H = 0.4", "holds"), ("H = 0.6", "not"), ("H = 0.9", "holds")]


def test_curves_that_leave_the_first_region_sooner_separate_first(sample):
    """κ = ζ X^α is twice π/(K₀₀ n) at X = (2π/(K₀₀ n ζ))^(1/α)."""
    end = {hurst: (2 * one_element_stiffness(ACROSS) / zeta_elastic(hurst)) ** (1 + hurst) for hurst in HURST}
    cases = curves.separation.judge(sample, 0.0)
    for case, (lower, higher) in zip(cases, pairwise(HURST), strict=True):
        assert case["value"] == pytest.approx(end[lower] / end[higher], rel=0.1)
        assert case["low"] < case["value"] < case["high"]
        assert case["verdict"] == "holds"


def test_interval_of_the_separation_assumes_independent_ensembles():
    """ln X at the end of region (a) scatters by 1/α of ln κ. The variances of both Hurst exponents add up."""
    sample = dataclasses.replace(evidence_with_factors(0.2), resamples=1000)
    error = stats.t.ppf(0.975, 79) * 0.2 / np.sqrt(80)
    for case, pair in zip(curves.separation.judge(sample, 0.0), pairwise(HURST), strict=True):
        expected = error * np.hypot(*(1 / exponent_alpha(hurst) for hurst in pair))
        assert np.log(case["high"] / case["low"]) / 2 == pytest.approx(expected, rel=0.1)


def test_contact_is_complete_only_if_most_elements_touch(sample):
    """The contact fraction of these discs is κ², so it is 1 where κ is 1."""
    assert {case["verdict"] for case in curves.complete_contact.judge(sample, 0.1)} == {"holds"}
    halved = sample.discs.assign(contact_count=sample.discs["contact_count"] / 2)
    cases = list(curves.complete_contact.judge(dataclasses.replace(sample, discs=halved), 0.1))
    assert {case["verdict"] for case in cases} == {"not"}
    assert all(case["value"] == pytest.approx(0.5, abs=0.01) for case in cases)


@pytest.mark.parametrize("number", [0, 1])
def test_region_c_of_curves_that_end_early_is_undecided(sample, number):
    reached = np.arange(sample.discs.sizes["abscissa"]) < number
    early = dataclasses.replace(sample, discs=sample.discs.where(xr.DataArray(reached, dims="abscissa")))
    cases = [*curves.last_region.judge(early, 0.05), *curves.complete_contact.judge(early, 0.1)]
    assert {case["verdict"] for case in cases} == {"undecided"}


def test_slope_and_prefactor_of_the_last_region_follow_the_curve():
    """A parabola of ln(vt/h) over ln X has a least-squares slope equal to its slope in the middle of the five steps."""
    log_x = np.log(X)
    stiffness = np.tile(X / np.exp(0.2 + 0.7 * log_x + 0.05 * log_x**2), (3, 1))
    sample = evidence_of_curves(stiffness, stiffness)
    slope = 0.7 + 0.1 * log_x[[-6, -1]].mean()
    assert [case["value"] for case in curves.last_region.judge(sample, 0.05)] == pytest.approx(
        [stiffness[0, -1], slope], rel=1e-9
    )


def test_interval_of_the_depth_contains_the_scatter_of_the_exponent():
    """For power laws with exponents β_i the ratio is ⟨β⟩⟨1/β⟩, which is known far better than ⟨1/β⟩ for a given ⟨β⟩.

    The ratio is close to 1 for every draw of discs. An interval with a fixed exponent would be several times wider.
    """
    exponents = 0.4 * np.exp(0.2 * np.random.default_rng(4).standard_normal((60, 1)))
    stiffness = 0.5 * X ** (1 - exponents)
    count = np.where(X < 1e-3, 2, 20) * np.ones_like(stiffness)  # region (b) begins far from the first abscissa
    (case,) = curves.depth.judge(evidence_of_curves(stiffness, count), 0.1)
    assert case["value"] == pytest.approx(exponents.mean() * (1 / exponents).mean(), rel=0.015)
    with_fixed_exponent = 2 * 1.96 * 0.2 / np.sqrt(60)
    assert 0 < case["high"] - case["low"] < with_fixed_exponent / 2
