"""Kinetics of ensembles in different media: results that all media share, and exact results."""

import numpy as np
import pytest

from viscorough.contact.loading_path import indent
from viscorough.media.kinds import KelvinVoigt, Maxwell, Newtonian, Springpot
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.comparisons.media_kinetics import COLUMNS, media_table
from viscorough_study.ensembles.averages import abscissa

MEDIA = {"newtonian": Newtonian(1e6), "maxwell": Maxwell(2.5e6, 1e6)}


@pytest.fixture(scope="module")
def ensembles():
    discs = [self_affine_disc(0.7, 33, rms=1e-6, diameter=1e-2, seed=seed) for seed in (1, 2)]
    return {0.7: [([indent(disc, until_fraction=0.3) for disc in discs], [1e-6, 1e-6], 1e-2)]}


@pytest.fixture(scope="module")
def table(ensembles):
    return media_table(ensembles, MEDIA, force=1e-4, times=abscissa(1e-3, 1e4, 20))


def test_newtonian_velocity_agrees_with_the_paper(ensembles, table):
    """The paper has vt/h = X/κ(X)."""
    rows = table[table["medium"] == "newtonian"]
    stiffness = [curve.at_force(4e-8 * rows["x"].to_numpy())[1] / 4e-2 for curve in ensembles[0.7][0][0]]
    expected = np.exp(np.log(rows["x"].to_numpy() / stiffness).mean(axis=0))
    np.testing.assert_allclose(rows["velocity"], expected, rtol=1e-12)
    assert list(table) == list(COLUMNS)
    last = min(curve.force[-1] for curve in ensembles[0.7][0][0])
    assert table["x"].max() * 4e-8 <= last, "times beyond the curves are left out"
    np.testing.assert_allclose(rows["x"], 1e-4 * rows["time"] / (4e-8 * 1e6), rtol=1e-14)


def test_depth_depends_on_time_only_through_the_creep_compliance(table):
    newtonian, maxwell = (table[table["medium"] == name] for name in MEDIA)
    inside = maxwell[(maxwell["x"] > newtonian["x"].min()) & (maxwell["x"] < newtonian["x"].max())]
    interpolated = np.interp(np.log(inside["x"]), np.log(newtonian["x"]), np.log(newtonian["depth"]))
    np.testing.assert_allclose(np.log(inside["depth"]), interpolated, atol=5e-3)  # interpolation between abscissae
    assert len(inside) > 50


def power_law_curve(factor, beta=0.4, *, until_force=1e-4):
    """Return the curve u = factor (F/G)^β at 400 levels; between them a cubic in the logarithms is exact."""
    force = np.geomspace(1e-12, until_force, 400)
    depth = factor * force**beta
    count, residual = np.arange(10, 4010, 10), np.zeros(400)
    return LoadingCurve(depth, force, force / (beta * depth), count, 5000, "boundary elements", 1e-3, 0, residual)


@pytest.mark.parametrize(
    ("medium", "times", "exponent"),
    [
        (Maxwell(1e6, 1e6), (1e3, 5e4), 0.4),  # at times much longer than τ = 1 s
        (KelvinVoigt(1e2, 1e6), (1e-2, 1e1), 0.4),  # at times much shorter than τ = 1e4 s
        (Springpot(1e6, 0.3), (1e-2, 1e2), 0.3 * 0.4),
    ],
)
def test_velocity_is_a_power_of_time_for_a_power_law_of_creep(medium, times, exponent):
    """vt/h ∝ X^β becomes ∝ t^(aβ) if J ∝ t^a, also in the means."""
    ensembles = {0.7: [([power_law_curve(factor) for factor in (0.9, 1.1)], [1e-3, 1e-3], 1.0)]}
    table = media_table(ensembles, {"medium": medium}, force=1e-3, times=abscissa(*times, 20))
    np.testing.assert_allclose(table["exponent"], exponent, atol=2e-3)


def test_mean_is_over_all_curves_that_reach_a_time():
    """Three curves are short; one continues alone."""
    short = [power_law_curve(factor, until_force=1e-6) for factor in (0.8, 1.0, 1.25)]
    groups = [(short, [1e-3] * 3, 1.0), ([power_law_curve(2.0)], [1e-3], 1.0)]
    table = media_table({0.7: groups}, {"newtonian": Newtonian(1e3)}, force=1e-3, times=abscissa(1e-3, 1e1, 20))
    early = table["time"] <= 1.0
    assert (table["realizations"] == np.where(early, 4, 1)).all()
    means = np.where(early, 2.0**0.25, 2.0)
    np.testing.assert_allclose(table["depth"], 1e3 * means * (1e-6 * table["time"]) ** 0.4, rtol=1e-6)
