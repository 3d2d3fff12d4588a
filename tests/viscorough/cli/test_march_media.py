"""`viscorough march` in viscoelastic media, and in the units that files state."""

import importlib
from contextlib import nullcontext

import numpy as np
import pytest

from viscorough.cli import main
from viscorough.io import netcdf
from viscorough.surfaces import self_affine_disc

MAXWELL = "kind: maxwell\nshear_modulus: 2.0\nviscosity: 3.0\n"


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("heights.npy", self_affine_disc(0.7, 17, rms=0.02, diameter=17.0, seed=3).heights)
    (tmp_path / "medium.yaml").write_text(MAXWELL)
    (tmp_path / "pulse.csv").write_text("time,force\n0,0\n1,0.2\n2,0.02\n3,0.02\n")
    return tmp_path


HEIGHTS = ["heights.npy", "--spacing", "1"]
MARCH = ["march", *HEIGHTS, "--medium", "medium.yaml", "-o", "march.nc"]


def values(file):
    return {name: variable.values for name, variable in netcdf.read(file).variables.items()}


@pytest.mark.parametrize(("method", "tolerance"), [("events", 1e-8), ("second_order", 1e-2), ("implicit", 0.1)])
@pytest.mark.usefixtures("here")
def test_marching_in_a_medium_agrees_with_kinetics(method, tolerance):
    times = ["--times", "0.25,0.5,0.75,1,1.25,1.5"]
    assert main([*MARCH, "--method", method, "--force", "0.1", *times]) == 0
    assert main(["indent", *HEIGHTS, "--tolerance", "1e-9", "--until-fraction", "1", "-o", "curve.nc"]) == 0
    assert main(["kinetics", "curve.nc", "--force", "0.1", "--medium", "medium.yaml", *times, "-o", "kin.nc"]) == 0
    marched, expected = values("march.nc"), values("kin.nc")
    np.testing.assert_allclose(marched["depth"][1:], expected["depth"], rtol=tolerance)
    assert marched["time"][0] == 0
    assert set(marched) == {"time", "depth", "force", "contact_count"}


@pytest.mark.parametrize("medium", [["--medium", "medium.yaml"], []], ids=["medium", "viscosity"])
@pytest.mark.usefixtures("here")
def test_steps_show_their_progress(monkeypatch, medium):
    shares = []
    module = importlib.import_module("viscorough.cli.march")
    monkeypatch.setattr(module, "progress_bar", lambda label, wanted: nullcontext(shares.append))
    assert main(["march", *HEIGHTS, "--method", "implicit", "--times", "1,2", "-o", "march.nc", *medium]) == 0
    assert shares[-2:] == pytest.approx([1 - 1 / len(shares), 1])


def test_marching_goes_on_where_contact_recedes(here, capsys):
    assert main(["indent", *HEIGHTS, "--until-fraction", "1", "-o", "curve.nc"]) == 0
    history = ["--medium", "medium.yaml", "--force-history", "pulse.csv", "-o", "kin.nc"]
    assert main(["kinetics", "curve.nc", *history]) == 2
    assert "the contact would recede" in capsys.readouterr().err
    assert not (here / "kin.nc").exists()
    assert main([*MARCH, "--method", "second_order", "--force-history", "pulse.csv"]) == 0
    content = netcdf.read("march.nc")
    assert content.attributes["receding_from"] == 2.0
    count, force = (content.variables[name].values for name in ("contact_count", "force"))
    np.testing.assert_array_equal(force, [0, 0.2, 0.02, 0.02])
    assert count[2] < count[1]
    assert main([*MARCH, "--method", "events", "--force-history", "pulse.csv"]) == 2


@pytest.mark.parametrize("method", ["events", "implicit"])
@pytest.mark.usefixtures("here")
def test_viscosities_are_in_pascal_seconds_where_the_unit_is_known(method):
    """The same surface in metres and in micrometres."""
    heights = np.load("heights.npy")
    np.save("metres.npy", 1e-6 * heights)
    common = ["--method", method, "--force", "1 N", "--viscosity", "2e12 Pa s"]
    common += [] if method == "events" else ["--times", "0.1,0.2"]
    assert main(["march", *HEIGHTS, "--unit", "um", *common, "-o", "um.nc"]) == 0
    metres = ["metres.npy", "--spacing", "1e-6", "--unit", "m"]
    assert main(["march", *metres, *common, "-o", "m.nc"]) == 0
    um, m = values("um.nc"), values("m.nc")
    np.testing.assert_allclose(um["time"], m["time"], rtol=1e-9, atol=1e-9 * m["time"][-1])
    np.testing.assert_allclose(um["depth"] * 1e-6, m["depth"], rtol=1e-6, atol=1e-9 * m["depth"][-1])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--method", "heun", "--times", "1"], "--method heun is not for --medium; allowed: events, implicit"),
        (["--method", "events"], "--times is needed by --method events"),
        (["--method", "implicit"], "--times is needed by"),
        (["--method", "implicit", "--times", "1", "--viscosity", "2"], "--medium replaces --viscosity"),
        (["--method", "implicit", "--times", "1", "--medium", "none.yaml"], "none.yaml: not readable"),
        (["--method", "implicit", "--times", "1", "--force", "1 mN"], "--force 1 mN: needs a plain number"),
        (["--method", "second_order", "--times", "1", "--overlap", "0.1"], "--overlap is not for"),
        (["--method", "second_order", "--times", "1", "--until-fraction", "0.1"], "--until-fraction is not for"),
        (["--method", "second_order", "--times", "0,1"], "0"),
        (["--method", "events", "--force-history", "march.nc"], "march.nc"),
    ],
)
def test_refusals(here, capsys, arguments, message):
    assert main([*MARCH, *arguments]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert not (here / "march.nc").exists()


def test_second_order_needs_a_medium(here, capsys):
    assert main(["march", *HEIGHTS, "--method", "second_order", "--times", "1", "-o", "march.nc"]) == 2
    assert "--method second_order is for use with --medium" in capsys.readouterr().err
    assert not (here / "march.nc").exists()
