"""Collapse of curves that follow one scaling law, or do not."""

from dataclasses import replace

import numpy as np
import pytest

from support.study import ELEMENTS, ensemble_of, pool_of
from viscorough.reference import exponent_beta
from viscorough_study.fits import scaling_collapse
from viscorough_study.fits.power_law import log_means
from viscorough_study.fits.scaling_collapse import (
    FINDINGS,
    Grid,
    collapse,
    collapse_table,
    grids,
    variance_share,
)

HURST = 0.6
BETA = exponent_beta(HURST)
STEP = np.log(10) / 10
SCATTER, LENGTH = 0.25, 1.0  # standard deviation of ln(vt/h) among realizations, and its correlation length in ln X
X_HIGH = 0.05


def grid(number, realizations, generator, *, beta=BETA, share=1.0):
    """Make an ensemble with vt/h = X^β, h over all waves; the scatter is a function of X N^(1+H)."""
    log_x = STEP * np.arange(np.ceil(np.log(2 * number ** -(1 + HURST)) / STEP), np.log(0.3) / STEP)
    kept = np.exp(-STEP / LENGTH)
    noise = SCATTER * generator.standard_normal((realizations, log_x.size))
    for i in range(1, log_x.size):
        noise[:, i] = kept * noise[:, i - 1] + np.sqrt(1 - kept**2) * noise[:, i]
    shift = np.log(share) / 2
    log_y = beta * (log_x + shift) - shift
    means = log_means(np.exp(log_y + noise), "geometric", 200, generator)
    return Grid(number, realizations, log_x, means, np.full(log_x.size, 100.0), 1.0, share)


def ensembles(seed, realizations=(40, 30, 20, 10), **options):
    generator = np.random.default_rng(seed)
    return [grid(*sizes, generator, **options) for sizes in zip((33, 129, 513, 2049), realizations, strict=True)]


def p_value(grids):
    return scaling_collapse.p_value([(member, member.curve("whole", X_HIGH)) for member in grids], BETA)


@pytest.mark.parametrize("realizations", [(40, 30, 20, 10), (16, 12, 8, 4)], ids=["many", "few"])
def test_one_law_is_accepted_in_95_percent(realizations):
    accepted = np.mean([p_value(ensembles(seed, realizations)) >= 0.05 for seed in range(100)])
    assert 0.88 <= accepted <= 0.99
    other = np.mean([p_value(ensembles(seed, realizations, beta=BETA + 0.1)) >= 0.05 for seed in range(20)])
    assert other <= 0.1


def test_exponents_that_collapse_curves_contain_the_true_one():
    beta = BETA + 0.06
    options = {"hurst": HURST, "quantity": "whole", "x_high": X_HIGH, "tolerance": 0.05}
    rows = [collapse(ensembles(seed, beta=beta), **options) for seed in range(9)]
    assert {row["finding"] for row in rows} == {"does not collapse"}
    assert sum(row["beta_low"] <= beta <= row["beta_high"] for row in rows) >= 7
    rows = [collapse(ensembles(seed), **options) for seed in range(9)]
    assert sum(row["finding"] == "collapses" for row in rows) >= 7
    assert {row["finding"] for row in rows} <= set(FINDINGS)


@pytest.mark.parametrize(("apart", "p", "finding"), [(0.965, 0.04, "does not collapse"), (0.945, 0.06, "undecided")])
def test_p_value_follows_from_the_distribution_of_spreads(apart, p, finding):
    """Two grids lie on either side of their mean. The spreads of 101 resamples are uniform from 0 to 1."""
    resamples = np.concatenate([[0], np.linspace(0, 1, 101) * np.sqrt(9 / 10)])  # the means of 10 scatter more
    log_x = STEP * np.arange(-30, 0)
    curves = [BETA * log_x + side * (apart + resamples[:, None]) for side in (-1, 1)]
    grids = [Grid(129, 10, log_x, curve, np.full(log_x.size, 100.0), 1.0, 1.0) for curve in curves]
    row = collapse(grids, HURST, "whole", 1.0, tolerance=0.05)
    assert row["p_value"] == pytest.approx(p, abs=1e-3)
    assert row["finding"] == finding
    assert np.isfinite(row["beta_low"]) == (finding == "undecided"), "equal N: any exponent, or none"


def test_rms_height_of_all_waves_collapses_the_grids():
    """Each grid resolves a different share of the height variance. Only h over all waves collapses the curves."""
    generator = np.random.default_rng(3)
    shares = {33: 0.5, 129: 0.65, 513: 0.8}
    grids = [grid(number, 60, generator, share=share) for number, share in shares.items()]
    assert p_value([replace(member, share=1.0) for member in grids]) < 0.05
    assert p_value(grids) >= 0.05


@pytest.mark.parametrize(("source", "hurst"), [("discs", 0.1), ("lines", 0.6), ("discs", 1.0)])
def test_variance_share_agrees_with_a_sum_over_waves(source, hurst):
    """The reference is a sum over many waves. The share rises to 1, and the rest falls as N^(−2H)."""
    shares = [variance_share(hurst, number, source) for number in (33, 257, 2049, 16385)]
    assert np.all(np.diff(shares) > 0)
    rest = 1 - np.array(shares)
    np.testing.assert_allclose(rest[1:-1] / rest[2:], 8 ** (2 * hurst), rtol=0.02)
    k = np.arange(-800, 801)
    square = (k[:, None] ** 2 + k**2 if source == "discs" else k[k > 0] ** 2).astype(float)
    power = -1 - hurst if source == "discs" else -0.5 - hurst
    weight = np.where((square > 0) & (square <= 800**2), np.maximum(square, 1) ** power, 0)
    ratio = weight[square <= 16.5**2].sum() / weight[square <= 128.5**2].sum()
    assert shares[0] / shares[1] == pytest.approx(ratio, rel=2e-3)


def pool(*realizations, scatter=0.0):
    """Make two grids of one Hurst exponent, with the same random factors on vt/h."""
    x = 10 ** np.arange(-4, 0, 0.1)
    members = []
    for elements, number in zip((ELEMENTS, 13049), realizations, strict=True):
        velocity = np.exp(scatter * np.random.default_rng(1).standard_normal((number, 1))) * x**0.4
        members.append(ensemble_of(x, x / velocity, 10 * x / x[10], hurst=HURST, elements=elements))
    return pool_of(members, "sizes")


CONVENTIONS = {"average": "geometric", "rms_convention": "disc"}
OF_POOL = {"conventions": CONVENTIONS, "elements_min": 10, "fraction_min": 0.95, "seed": 1}


def test_realizations_of_each_grid_are_drawn_independently():
    """Resamples of equal curves on two grids are uncorrelated: 0.2 is four standard errors of 400 pairs."""
    by_hurst = grids(pool(20, 20, scatter=0.1), "discs", **OF_POOL, resamples=400)
    coarse, fine = (member.log_velocity[1:, 0] for member in by_hurst[HURST])
    assert abs(np.corrcoef(coarse, fine)[0, 1]) < 0.2


def test_grids_with_few_realizations_are_left_out():
    """One of the grids has too few realizations."""
    by_hurst = grids(pool(4, 2), "discs", **OF_POOL, resamples=20)
    (member,) = by_hurst[HURST]
    assert (member.number, member.realizations, member.log_velocity.shape[0]) == (257, 4, 21)
    assert member.punch == pytest.approx(0.99486, abs=1e-4)
    assert member.log_x[0] == pytest.approx(np.log(1e-3))
    np.testing.assert_allclose(member.log_velocity, np.tile(0.4 * member.log_x, (21, 1)))
    assert member.curve("whole", 1e-9) is None
    table = collapse_table({"discs": by_hurst}, x_high=[0.03], tolerance=0.03)
    assert list(table) == list(scaling_collapse.COLUMNS)
    assert table["finding"].tolist() == ["undecided"] * 2
