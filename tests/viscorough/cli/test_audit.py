"""`viscorough indent --audit`, through real files; docs/own_surface.md shows what it prints."""

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


def test_disagreement_is_a_warning(here, capsys, monkeypatch):
    monkeypatch.setattr(sum_rules.Audit, "agrees", False)
    assert run(INDENT) == 0
    printed, attributes = capsys.readouterr(), netcdf.read("out.nc").attributes
    assert "warning: Audit over" in printed.err
    assert attributes["warnings"].startswith("Audit over")
    assert printed.out.endswith(f"49 of 49 elements in contact\n{attributes['audit']}\n")
