"""`viscorough march`: agreement with kinetics, force histories, media, units, and refusals."""

import numpy as np
import pytest

from support.command_line import run, values
from viscorough import self_affine_disc
from viscorough.io.datasets import read_dataset

HEIGHTS = self_affine_disc(0.7, 13, rms=0.02, diameter=13.0, seed=3).heights
MARCH = "march heights.npy --spacing 1 --unit 1 -o march.nc"


@pytest.fixture(autouse=True)
def here(here):
    np.save("heights.npy", HEIGHTS)
    (here / "medium.yaml").write_text("kind: maxwell\nshear_modulus: 2.0\nviscosity: 3.0\n")
    (here / "pulse.csv").write_text("time,force\n0,0\n1,0.2\n2,0.02\n3,0.02\n")
    return here


CONSTANT = "--force 0.1 --times 0.25,0.5,0.75,1,1.25,1.5"
PULSE = "--medium medium.yaml --force-history pulse.csv"


@pytest.mark.parametrize(
    ("motion", "method", "tolerance"),
    [
        (f"--viscosity 3 {CONSTANT}", "events", 1e-8),
        (f"--medium medium.yaml {CONSTANT}", "implicit", 1e-2),
        (PULSE, "implicit", 5e-2),
    ],
)
def test_marching_agrees_with_kinetics(motion, method, tolerance):
    """The contact recedes under the pulse."""
    assert run(f"{MARCH} --method {method} {motion}") == 0
    assert run("indent heights.npy --spacing 1 --unit 1 --tolerance 1e-9 --until-fraction 1 -o curve.nc") == 0
    assert run(f"kinetics curve.nc {motion} -o kin.nc") == 0
    marched, expected = values("march.nc"), values("kin.nc")
    last = slice(-expected["time"].size, None)
    assert set(marched) == set(expected) == {"time", "depth", "velocity", "force", "contact_fraction"}
    np.testing.assert_allclose(marched["depth"][last], expected["depth"], rtol=tolerance)
    np.testing.assert_allclose(marched["time"][last], expected["time"], rtol=1e-15)
    np.testing.assert_allclose(marched["force"][last], expected["force"], rtol=1e-15)
    if method == "events":
        np.testing.assert_allclose(marched["velocity"][last], expected["velocity"], rtol=10 * tolerance)


def test_march_continues_while_contact_recedes(complaint):
    message = "--method events, a medium that is not Newtonian; allowed: a force on a Newtonian medium, or --method"
    assert message in complaint(f"{MARCH} --method events {PULSE}")
    assert run(f"{MARCH} --method implicit {PULSE}") == 0
    content = read_dataset("march.nc")
    assert content.attrs["receding_from"] == 2.0
    fraction, force = (content.variables[name].values for name in ("contact_fraction", "force"))
    np.testing.assert_array_equal(force, [0, 0.2, 0.02, 0.02])
    assert fraction[2] < fraction[1]
