"""Kinetics of ensembles in other media: what all media share, and what is exact."""

import numpy as np
import pytest

from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough.viscous.media import Maxwell, Newtonian
from viscorough_study.ensembles import abscissa
from viscorough_study.media_kinetics import COLUMNS, media_table, named_media

MEDIA = {"newtonian": Newtonian(1e6), "maxwell": Maxwell(2.5e6, 1e6)}


@pytest.fixture(scope="module")
def ensembles():
    discs = [self_affine_disc(0.7, 33, rms=1e-6, diameter=1e-2, seed=seed) for seed in (1, 2)]
    return {0.7: ([indent(disc, until_fraction=0.3) for disc in discs], [1e-6, 1e-6], 1e-2)}


@pytest.fixture(scope="module")
def table(ensembles):
    return media_table(ensembles, MEDIA, force=1e-4, times=abscissa(1e-3, 1e4, 20))


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
