"""Kinetics of ensembles in other media: what all media share, and what is exact."""

import numpy as np
import pytest

from viscorough.contact.loading_path import indent
from viscorough.loading_curve import LoadingCurve
from viscorough.surfaces import self_affine_disc
from viscorough.viscous.media import KelvinVoigt, Maxwell, Newtonian, Springpot, StandardLinearSolid
from viscorough_study.ensembles import abscissa
from viscorough_study.media_kinetics import COLUMNS, EXPONENT_COLUMNS, media_tables, named_media

FIT = {"stiffness_range": [0.03, 0.3], "resamples": 20, "seed": 1}
MEDIA = {"newtonian": Newtonian(1e6), "maxwell": Maxwell(2.5e6, 1e6)}


@pytest.fixture(scope="module")
def ensembles():
    discs = [self_affine_disc(0.7, 33, rms=1e-6, diameter=1e-2, seed=seed) for seed in (1, 2)]
    return {0.7: ([indent(disc, until_fraction=0.3) for disc in discs], [1e-6, 1e-6], 1e-2)}


@pytest.fixture(scope="module")
def table(ensembles):
    return media_tables(ensembles, MEDIA, force=1e-4, times=abscissa(1e-3, 1e4, 20), **FIT)[0]


def test_newtonian_velocity_is_that_of_the_paper(ensembles, table):
    """vt/h = X/κ(X)."""
    rows = table[table["medium"] == "newtonian"]
    stiffness = [curve.at_force(4e-8 * rows["x"].to_numpy())[1] / 4e-2 for curve in ensembles[0.7][0]]
    expected = np.exp(np.log(rows["x"].to_numpy() / stiffness).mean(axis=0))
    np.testing.assert_allclose(rows["velocity"], expected, rtol=1e-12)
    np.testing.assert_allclose(rows["x"], 1e-4 * rows["time"] / (4e-8 * 1e6), rtol=1e-14)


def test_depth_is_one_function_of_the_creep_compliance(table):
    newtonian, maxwell = (table[table["medium"] == name] for name in MEDIA)
    inside = maxwell[(maxwell["x"] > newtonian["x"].min()) & (maxwell["x"] < newtonian["x"].max())]
    interpolated = np.interp(np.log(inside["x"]), np.log(newtonian["x"]), np.log(newtonian["depth"]))
    np.testing.assert_allclose(np.log(inside["depth"]), interpolated, atol=5e-3)  # between abscissae
    assert len(inside) > 50


def test_times_beyond_the_curves_are_left_out(ensembles, table):
    """And the exponent is 1 where the elastic depth has been reached and the velocity hardly changes."""
    assert list(table) == list(COLUMNS)
    last = min(curve.force[-1] for curve in ensembles[0.7][0])
    assert table["x"].max() * 4e-8 <= last < 1e-4 * MEDIA["maxwell"].creep_compliance(1e4)
    first = table[table["medium"] == "maxwell"].iloc[0]
    assert first["exponent"] == pytest.approx(1, abs=0.01)
    assert (table["realizations"] == 2).all()


def test_media_of_the_settings():
    cases = [{"name": "paper", "kind": "newtonian", "viscosity": 1e6}]
    assert named_media(cases) == {"paper": Newtonian(1e6)}


def power_law_curve(factor, beta=0.4):
    """u = factor (F/G)^β at 400 levels; between them a cubic in the logarithms is exact."""
    force = np.geomspace(1e-12, 1e-4, 400)
    depth = factor * force**beta
    return LoadingCurve(
        depth=depth,
        force=force,
        stiffness=force / (beta * depth),
        contact_count=np.arange(10, 4010, 10),
        elements=5000,
        method="boundary elements",
        tolerance=1e-3,
        operator_applications=0,
        residual=np.zeros(400),
    )


@pytest.mark.parametrize(
    ("medium", "times", "creep", "exponent"),
    [
        (Newtonian(1e6), (1e-2, 1e2), 1.0, 0.4),
        (Maxwell(1e6, 1e6), (1e3, 5e4), 1.0, 0.4),  # τ = 1 s: later
        (KelvinVoigt(1e2, 1e6), (1e-2, 1e1), 1.0, 0.4),  # τ = 1e4 s: earlier
        (Springpot(1e6, 0.3), (1e-2, 1e2), 0.3, 0.3 * 0.4),
    ],
)
def test_power_of_time_of_a_power_law(medium, times, creep, exponent):
    """vt/h ∝ X^β is ∝ t^(aβ) where J ∝ t^a, in the means, in the fit, and by Eq. 10 of β = H/(1 + H)."""
    ensembles = {2 / 3: ([power_law_curve(factor) for factor in (0.9, 1.1)], [1e-3, 1e-3], 1.0)}  # H/(1 + H) = 0.4
    how = FIT | {"stiffness_range": [0.0, 10.0]}
    table, fits = media_tables(ensembles, {"medium": medium}, force=1e-3, times=abscissa(*times, 20), **how)
    fit = fits.iloc[0]
    assert list(fits) == list(EXPONENT_COLUMNS)
    np.testing.assert_allclose(table["exponent"], exponent, atol=2e-3)
    np.testing.assert_allclose(table["expected"], exponent, atol=2e-3)
    assert (fit["exponent"], fit["expected"], fit["beta"]) == pytest.approx((exponent, exponent, 0.4), abs=2e-3)
    assert fit["exponent_low"] <= fit["exponent"] <= fit["exponent_high"]
    assert (fit["creep_exponent"], fit["creep_least"], fit["creep_largest"]) == pytest.approx((creep,) * 3, abs=2e-3)
    assert fit["decades"] == pytest.approx(np.log10(times[1] / times[0]), abs=0.05)


def test_no_power_of_time_where_the_medium_has_none():
    """The creep exponent of a standard linear solid changes over the window, of a relaxed one there is no window.

    Of a power law in X, the exponent in time is that of J and of the change of d ln J/d ln t.
    """
    ensembles = {0.5: ([power_law_curve(1.0)] * 2, [1e-3, 1e-3], 1.0)}
    media = {"solid": StandardLinearSolid(1e6, 1e5, 1.0), "spring": StandardLinearSolid(1e6, 1e5, 1e-6)}
    how = FIT | {"stiffness_range": [0.0, 10.0]}
    _, fits = media_tables(ensembles, media, force=1e-3, times=abscissa(1e-2, 1e2, 20), **how)
    solid, spring = fits.to_dict("records")
    assert solid["creep_largest"] - solid["creep_least"] > 0.4
    assert solid["exponent"] == pytest.approx(solid["expected"], abs=2e-3)
    assert abs(solid["expected"] - 0.4 * solid["creep_exponent"]) > 0.1
    assert spring["decades"] == 0
    assert np.isnan(spring["exponent"])
