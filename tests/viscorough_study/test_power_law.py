"""Scaling: ensembles of known power laws and regions, made without the module."""

import numpy as np
import pytest
import xarray as xr
from scipy.special import gamma as gamma_function
from scipy.stats import binom

from viscorough import reference
from viscorough.mdr import reduce
from viscorough.surfaces import self_affine_line
from viscorough_study.ensembles import abscissa, aggregate
from viscorough_study.power_law import (
    COLUMNS,
    find_region,
    fit_power_law,
    local_slope,
    match_lambda,
    named_windows,
    scaling_rows,
)
from viscorough_study.seeds import realization_seed

x = abscissa(1e-7, 10, 20)
LIMITS = {"elements_min": 10, "stiffness_max": 0.2, "slope_max": 0.8}
BOOTSTRAP = {"resamples": 400, "seed": 1}


def ensemble_of(stiffness, x=x, elements=10**6, rms_convention="disc", hurst=0.7):
    """Ensemble dataset of κ, shape (realizations, abscissae), with κ N elements in contact."""
    stiffness = np.maximum(np.atleast_2d(stiffness), 1 / elements)
    geometric = np.exp(np.nanmean(np.log(stiffness), axis=0))
    defined = np.isfinite(stiffness).mean(axis=0)
    averages = {
        "stiffness_geometric": geometric,
        "velocity_geometric": x / geometric,
        "contact_count_median": elements * np.nanmedian(stiffness, axis=0),
        "fraction_defined": defined,
    }
    dataset = xr.Dataset({name: (("rms_convention", "abscissa"), [row]) for name, row in averages.items()})
    dataset["velocity"] = (("rms_convention", "realization", "abscissa"), [x / stiffness])
    return dataset.assign_coords(x=("abscissa", x), rms_convention=[rms_convention], hurst=hurst)


def one(dataset):
    return dataset.isel(rms_convention=0)


def scattered(beta, prefactor, realizations, seed, *, slope_scatter=0.03, scatter=0.3):
    """vt/h of power laws, each of its own slope and prefactor; their geometric mean is the law."""
    rng = np.random.default_rng(seed)
    log_x = np.log(x)
    slopes = beta + slope_scatter * rng.normal(size=(realizations, 1))
    logs = np.log(prefactor) + slopes * log_x + scatter * rng.normal(size=(realizations, 1))
    return np.exp(logs + 0.05 * rng.normal(size=logs.shape))


# regions: (a) one element of a million, (b) κ = 1.2 X^0.6, (c) κ = 1
three_regions = np.clip(1.2 * x**0.6, 1e-6, 1)


def test_local_slope_of_the_three_regions():
    slope = local_slope(x, x / three_regions)
    low, high = (1e-6 / 1.2) ** (1 / 0.6), 1.2 ** (-1 / 0.6)
    inner = (x > 2 * low) & (x < high / 2)
    np.testing.assert_allclose(slope[inner], 0.4, atol=1e-12)
    np.testing.assert_allclose(slope[x > 2 * high], 1, atol=1e-12)
    assert np.isnan(local_slope(x, np.full(x.size, np.nan))).all()


def test_region_of_a_three_region_curve():
    """Its ends are the outermost abscissae with 10 elements in contact and κ = 0.2."""
    for elements in (10**3, 10**4):
        low, high = find_region(one(ensemble_of(three_regions, elements=elements)), **LIMITS)
        assert low == x[x >= (10 / elements / 1.2) ** (1 / 0.6)][0]
        assert high == x[x <= (0.2 / 1.2) ** (1 / 0.6)][-1]


def test_region_ends_where_the_slope_is_that_of_a_fixed_contact():
    """A plateau of κ below stiffness_max, such as a flat-topped asperity, is no region (b)."""
    plateau = np.minimum(1.2 * x**0.6, 0.05)
    _, high = find_region(one(ensemble_of(plateau)), **LIMITS)
    corner = (0.05 / 1.2) ** (1 / 0.6)
    assert corner / 10**0.25 < high < corner * 10**0.25


def test_region_needs_nearly_all_realizations():
    stiffness = np.tile(three_regions, (20, 1))
    stiffness[:2, x > 1e-3] = np.nan  # 90 % left
    _, high = find_region(one(ensemble_of(stiffness)), **LIMITS)
    assert high == x[x <= 1e-3][-1]
    _, high = find_region(one(ensemble_of(stiffness)), fraction_min=0.9, **LIMITS)
    assert high > 1e-2


def test_region_is_the_longest_run():
    count = np.where((x > 1e-5) & (x < 1.5e-5), 0, 1)
    mean = one(ensemble_of(three_regions))
    mean["contact_count_median"] = mean["contact_count_median"] * count
    low, _ = find_region(mean, **LIMITS)
    assert low == x[x >= 1.5e-5][0]


@pytest.mark.parametrize("stiffness", [np.ones(x.size), np.full(x.size, 0.1), np.full(x.size, np.nan)])
def test_no_region_raises_and_its_windows_are_none(stiffness):
    mean = one(ensemble_of(three_regions))
    mean["stiffness_geometric"] = "abscissa", stiffness
    mean["velocity_geometric"] = "abscissa", x / stiffness
    with pytest.raises(ValueError, match=r"^find_region: .*0\.5 decades") as caught:
        find_region(mean, **LIMITS)
    assert "\n" not in str(caught.value)
    windows = named_windows(mean, stiffness_range=(0.5, 0.6), **LIMITS)
    assert windows == dict.fromkeys(("default", "lower_half", "upper_half", "kappa"))


def test_named_windows():
    windows = named_windows(one(ensemble_of(three_regions)), stiffness_range=(0.03, 0.3), **LIMITS)
    low, high = windows["default"]
    assert windows["lower_half"][0] == low
    assert windows["upper_half"][1] == high
    assert windows["lower_half"][1] == windows["upper_half"][0] == pytest.approx(np.sqrt(low * high))
    inside = x[(three_regions >= 0.03) & (three_regions <= 0.3)]
    assert windows["kappa"] == (inside[0], inside[-1])


@pytest.mark.parametrize("average", ["arithmetic", "geometric"])
def test_exact_power_law_is_recovered_exactly(average):
    velocity = np.tile(x**0.37 / 1.6, (5, 1))
    fit = fit_power_law(x, velocity, (1e-5, 1e-1), average=average, **BOOTSTRAP)
    assert fit.beta == pytest.approx(0.37, abs=1e-12)
    assert fit.beta_interval == pytest.approx((0.37, 0.37), abs=1e-12)
    assert fit.zeta() == pytest.approx((1.6, 1.6, 1.6), rel=1e-11)
    assert fit.residual == pytest.approx(0, abs=1e-12)


def test_fit_is_least_squares_in_logarithms():
    """Against numpy's polynomial fit, of the averages taken by numpy; window ends belong to it."""
    velocity = scattered(0.4, 0.7, 9, seed=2)
    inside = slice(60, 101)
    for average, mean in (
        ("arithmetic", np.log(velocity.mean(axis=0))),
        ("geometric", np.log(velocity).mean(axis=0)),
    ):
        fit = fit_power_law(x, velocity, (x[60], x[100]), average=average, **BOOTSTRAP)
        slope, height = np.polyfit(np.log(x[inside]), mean[inside], 1)
        assert fit.beta == pytest.approx(slope, rel=1e-10)
        assert fit.zeta()[0] == pytest.approx(np.exp(-height), rel=1e-10)
        deviation = mean[inside] - height - slope * np.log(x[inside])
        assert fit.residual == pytest.approx(np.sqrt(np.mean(deviation**2)), rel=1e-8)


def test_bootstrap_is_that_of_drawing_curves_one_by_one():
    """The spread of β over resamples against a plain loop: two estimates of one standard deviation."""
    velocity, window = scattered(0.4, 0.7, 20, seed=3), (1e-5, 1e-1)
    fit = fit_power_law(x, velocity, window, average="arithmetic", resamples=4000, seed=1)
    inside, rng = (x >= window[0]) & (x <= window[1]), np.random.default_rng(5)
    slopes = [
        np.polyfit(np.log(x[inside]), np.log(velocity[drawn][:, inside].mean(axis=0)), 1)[0]
        for drawn in rng.integers(20, size=(4000, 20))
    ]
    # relative standard error of a standard deviation of 4000 values is 1/√8000 = 1.1 %, twice of it: 1.6 %
    assert np.std(fit.beta_samples) == pytest.approx(np.std(slopes), rel=0.06)
    assert np.mean(fit.beta_samples) == pytest.approx(np.mean(slopes), abs=4 * np.std(slopes) / np.sqrt(2000))


@pytest.mark.parametrize("realizations", [8, 24])
def test_intervals_cover_the_truth_95_times_in_100(realizations):
    """200 ensembles; the number of hits lies in the 99.9 % range of the binomial distribution.

    That a percentile interval of 8 realizations without widening would fail here is part of the point.
    """
    hits = np.zeros(3)
    for seed in range(200):
        velocity = scattered(0.4, 0.7, realizations, seed=(realizations, seed))
        fit = fit_power_law(x, velocity, (1e-5, 1e-1), average="geometric", resamples=400, seed=seed)
        _, zeta_low, zeta_high = fit.zeta()
        plain = np.quantile(fit.beta_samples, [0.025, 0.975])
        truth = (0.4, 1 / 0.7, 0.4)
        intervals = (fit.beta_interval, (zeta_low, zeta_high), plain)
        hits += [low <= value <= high for value, (low, high) in zip(truth, intervals, strict=True)]
    fewest, most = binom.interval(0.999, 200, 0.95)
    assert fewest <= hits[0] <= most
    assert fewest <= hits[1] <= most
    if realizations == 8:
        assert hits[2] < hits[0]


def test_arithmetic_exceeds_geometric_mean_by_half_the_variance():
    """Lognormal scatter σ: ln of the ratio of prefactors is σ²/2, and β the same."""
    sigma, n = 0.4, 5000
    scatter = sigma * np.random.default_rng(4).normal(size=(n, 1))
    velocity = x**0.4 * np.exp(scatter)
    fits = [fit_power_law(x, velocity, (1e-4, 1e-2), average=a, **BOOTSTRAP) for a in ("arithmetic", "geometric")]
    assert fits[0].beta == pytest.approx(fits[1].beta, abs=1e-12)
    # standard error of mean(e^y)/e^mean(y): √((e^σ² − 1 − σ²)/n) = 0.0017 for these; four of them
    assert np.log(fits[0].prefactor / fits[1].prefactor) == pytest.approx(sigma**2 / 2, abs=0.007)


def test_partly_defined_realizations_count_where_they_are_defined():
    velocity = np.vstack([x**0.4, 3 * x**0.4])
    velocity[1, x > 1e-3] = np.nan
    fit = fit_power_law(x, velocity, (2e-3, 1e-1), average="arithmetic", **BOOTSTRAP)
    assert fit.beta == pytest.approx(0.4, abs=1e-12)
    assert fit.prefactor == pytest.approx(1, rel=1e-12)
    assert np.isnan(fit.beta_samples).any()  # resamples of nothing but the second curve
    assert fit.beta_interval == pytest.approx((0.4, 0.4), abs=1e-12)
    velocity[0, x > 1e-2] = np.nan
    with pytest.raises(ValueError, match="no realization"):
        fit_power_law(x, velocity, (2e-3, 1e-1), average="arithmetic", **BOOTSTRAP)


def test_single_realization_has_no_interval():
    fit = fit_power_law(x, x[None] ** 0.4, (1e-4, 1e-2), average="geometric", **BOOTSTRAP)
    assert np.isnan(fit.beta_interval).all()


def test_fit_refuses():
    velocity = np.tile(x**0.4, (3, 1))
    with pytest.raises(ValueError, match="at least 3"):
        fit_power_law(x, velocity, (1.0e-4, 1.1e-4), average="geometric", **BOOTSTRAP)
    with pytest.raises(ValueError, match="average"):
        fit_power_law(x, velocity, (1e-4, 1e-2), average="harmonic", **BOOTSTRAP)
    fit = fit_power_law(x, velocity, (1e-4, 1e-2), average="geometric", **BOOTSTRAP)
    with pytest.raises(ValueError, match="diameter"):
        fit.zeta(diameter_convention="width")


@pytest.mark.parametrize("gamma", [False, True])
def test_both_readings_describe_the_same_curve(gamma):
    """ζ of either reading, put into the paper's law of that reading, gives back the curve."""
    velocity = scattered(0.375, 0.7, 6, seed=6, slope_scatter=0)
    fit = fit_power_law(x, velocity, (1e-4, 1e-2), average="geometric", **BOOTSTRAP)
    law = reference.velocity_law(x, fit.zeta(gamma=gamma)[0], 1 - fit.beta, gamma=gamma)
    np.testing.assert_allclose(law, fit.prefactor * x**fit.beta, rtol=1e-12)
    ratio = fit.zeta(gamma=True)[0] / fit.zeta()[0]
    assert ratio == pytest.approx(1 / gamma_function(1 + fit.beta))


def test_radius_for_diameter_is_a_fit_on_doubled_abscissae():
    """κ = k/(4GL) and X = F/(4GhL) both double with L/2; vt/h is measured and stays."""
    velocity = scattered(0.4, 0.7, 10, seed=7)
    window = np.array([x[60], x[100]])
    fit = fit_power_law(x, velocity, window, average="arithmetic", **BOOTSTRAP)
    doubled = fit_power_law(2 * x, velocity, 2 * window, average="arithmetic", **BOOTSTRAP)
    assert fit.zeta(diameter_convention="radius") == pytest.approx(doubled.zeta(), rel=1e-9)
    assert fit.beta == pytest.approx(doubled.beta, rel=1e-12)
    assert fit.zeta(diameter_convention="radius")[0] == pytest.approx(2**fit.beta * fit.zeta()[0])


def test_lambda_of_power_laws():
    """ζ1 and ζ3 of equal exponents: s = (ζ1/ζ3)^(1/α), λ = π s²."""
    alpha, zeta1, zeta3 = 0.6, 1.3, 1.0
    discs, lines = np.tile(x / (zeta3 * x**alpha), (4, 1)), np.tile(x / (zeta1 * x**alpha), (6, 1))
    for average in ("arithmetic", "geometric"):
        found = match_lambda(x, discs, lines, (1e-4, 3e-2), average=average, **BOOTSTRAP)
        assert found == pytest.approx([np.pi * (zeta1 / zeta3) ** (2 / alpha)] * 3, rel=1e-9)


def test_lambda_of_a_line_stretched_in_height():
    """Any curve: discs that are the lines with s times the rms height, y3(X) = s y1(X/s), give back s."""
    steps = 7
    s = 10 ** (steps / 20)
    lines = scattered(0.4, 0.7, 12, seed=8) * (1 + 0.5 * x)  # bent
    discs = s * np.roll(lines, steps, axis=1)
    found, low, high = match_lambda(x, discs, lines, (1e-4, 1e-2), average="arithmetic", **BOOTSTRAP)
    assert found == pytest.approx(np.pi * s**2, rel=1e-9)
    assert low < found < high
    same, *_ = match_lambda(x, lines, lines, (1e-4, 1e-2), average="geometric", **BOOTSTRAP)
    assert same == pytest.approx(np.pi, rel=1e-9)


def test_lambda_refuses_lines_that_do_not_reach():
    discs = np.tile(x / three_regions, (3, 1))
    lines = discs.copy()
    lines[0, x > 1e-5] = np.nan
    with pytest.raises(ValueError, match="do not reach"):
        match_lambda(x, discs, lines, (1e-3, 1e-2), average="geometric", **BOOTSTRAP)


def rows_of(ensemble, **changes):
    about = {"source": "discs", "case_group": "base", "stiffness_range": (0.03, 0.3)}
    return scaling_rows(ensemble, **(about | LIMITS | BOOTSTRAP | changes))


def test_rows_hold_every_convention_once():
    discs = ensemble_of(three_regions * np.exp(0.2 * np.random.default_rng(9).normal(size=(8, 1))))
    lines = ensemble_of(np.tile(1.3 * three_regions, (9, 1)), rms_convention="line")
    rows = rows_of(discs, lines=lines)
    names = ("rms_convention", "average", "window_rule", "gamma", "diameter_convention")
    assert len(rows) == len({tuple(row[name] for name in names) for row in rows}) == 2 * 4 * 2 * 2
    for row in rows:
        assert list(row) == list(COLUMNS)
        assert row["decades"] == pytest.approx(np.log10(row["x_high"] / row["x_low"]))
        assert row["beta_low"] <= row["beta"] <= row["beta_high"]
        assert row["zeta_low"] <= row["zeta"] <= row["zeta_high"]
        assert row["realizations"] == 8
    # without Γ, diameter: a known mean; κ1/κ3 = 1.3/e^mean
    row = next(r for r in rows if r["average"] == "geometric" and r["window_rule"] == "default")
    zeta = one(discs).stiffness_geometric.values[100] / x[100] ** 0.6
    assert (row["gamma"], row["diameter_convention"]) == ("without", "diameter")
    assert row["zeta"] == pytest.approx(zeta, rel=1e-9)
    assert row["lambda"] == pytest.approx(np.pi * (1.3 * 1.2 / zeta) ** (2 / 0.6), rel=1e-9)
    radius = rows[rows.index(row) + 1]
    assert radius["diameter_convention"] == "radius"
    assert radius["x_low"] == 2 * row["x_low"]
    assert radius["lambda"] == row["lambda"]


def test_rows_are_reproducible_and_need_no_lines():
    ensemble = ensemble_of(three_regions * np.exp(0.2 * np.random.default_rng(9).normal(size=(8, 1))))
    first, second = (rows_of(ensemble, seed=np.random.SeedSequence(3, spawn_key=(1,))) for _ in range(2))
    np.testing.assert_equal(first, second)
    assert all(np.isnan(row["lambda"]) for row in first)


def test_without_a_region_rows_say_so():
    rows = rows_of(ensemble_of(np.ones((4, x.size))))
    assert len(rows) == 32
    for row in rows:
        assert row["decades"] == 0
        assert all(np.isnan(row[name]) for name in ("x_low", "x_high", "beta", "zeta", "residual", "lambda"))


def test_rows_refuse_unlike_abscissae():
    with pytest.raises(ValueError, match="same abscissae"):
        rows_of(ensemble_of(three_regions), lines=ensemble_of(three_regions[1:], x=x[1:]))


def test_lines_of_self_affine_roughness_have_the_exponent_of_the_paper():
    """β = H/(1 + H) (Eq. 10) at H = 0.7, by the MDR: within 0.03.

    The bootstrap gives a standard error of 0.008 for 40 lines; the rest allows for the curvature that 13
    octaves of roughness leave. The halves of the window have twice the error, and are allowed twice as much.
    """
    hurst = 0.7
    curves = [reduce(self_affine_line(hurst, 2**14, seed=realization_seed(1, 3, i))) for i in range(40)]
    ensemble = aggregate(curves, {"line": 1.0}, 1.0, x, hurst=hurst, case="lines")
    rows = {
        row["window_rule"]: row
        for row in rows_of(ensemble, source="lines")
        if (row["average"], row["gamma"], row["diameter_convention"]) == ("geometric", "without", "diameter")
    }
    default = rows["default"]
    assert default["decades"] > 3
    assert default["beta"] == pytest.approx(reference.exponent_beta(hurst), abs=0.03)
    assert default["beta_high"] - default["beta_low"] < 0.06
    assert rows["lower_half"]["beta"] == pytest.approx(reference.exponent_beta(hurst), abs=0.06)
    assert rows["upper_half"]["beta"] == pytest.approx(reference.exponent_beta(hurst), abs=0.06)
