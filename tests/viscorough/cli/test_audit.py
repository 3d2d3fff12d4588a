"""`viscorough indent --audit`, through real files."""

import numpy as np
import pytest

from support.command_line import run, sphere_heights
from viscorough import sum_rules
from viscorough.io import netcdf

INDENT = "indent heights.npy --spacing 1 --unit um --audit -o out.nc"


@pytest.fixture
def here(here):
    """A working folder that holds only a small heights.npy."""
    np.save("heights.npy", 0.1 * sphere_heights(9))
    return here


def test_integrals_are_printed_and_stored(here, capsys):
    assert run(f"{INDENT} --tolerance 1e-6") == 0
    closing, verdict, *integrals = capsys.readouterr().out.splitlines()
    assert closing.startswith("out.nc: ")
    assert closing.endswith("49 of 49 elements in contact")
    assert verdict.endswith("both integrals agree to 1e-06")
    assert [(line[:8], line.split(",")[0].split()[-1]) for line in integrals] == [
        ("mean gap", "um"),
        ("energy U", "um3"),
    ]
    assert netcdf.read("out.nc").attributes["audit"] == "\n".join([verdict, *integrals])


def test_disagreement_is_a_warning(here, capsys, monkeypatch):
    monkeypatch.setattr(sum_rules.Audit, "agrees", False)
    assert run(INDENT) == 0
    assert "warning: Audit over" in capsys.readouterr().err
    assert netcdf.read("out.nc").attributes["warnings"].startswith("Audit over")
