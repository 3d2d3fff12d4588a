"""Problems too large for the available memory are refused before anything is allocated."""

import re
from types import SimpleNamespace

import numpy as np
import psutil
import pytest

from viscorough import Indenter, self_affine_disc, self_affine_line
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.viscous.integration.elements import elements_of_map


def test_surfaces_too_large_for_any_memory_are_refused():
    """No machine has enough memory for these sizes."""
    with pytest.raises(
        MemoryError, match=r"a surface of 160008 x 160008 points takes .* bytes of memory, .* available"
    ):
        self_affine_disc(0.5, 20_001 * 8, seed=1)
    with pytest.raises(MemoryError, match=r"a line of 100000000000000 points takes .* bytes of memory, .* available"):
        self_affine_line(0.5, 10**14, seed=1)


def demand(compute, monkeypatch):
    """Return the bytes that a computation requires."""
    with monkeypatch.context() as patch:
        patch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=0))
        with pytest.raises(MemoryError) as error:
            compute()
    return float(re.search(r"takes (\S+) bytes", str(error.value))[1])


def test_dense_interactions_of_direct_integration_require_three_matrices(monkeypatch):
    elements = elements_of_map(Indenter(np.random.default_rng(1).random((20, 20)), 1.0), "march")
    members = np.arange(200)
    assert demand(lambda: elements.influence_among(members), monkeypatch) == 3 * 8 * 200**2


def test_complete_contact_too_large_for_the_memory_is_refused(monkeypatch):
    solver = ContactSolver(self_affine_disc(0.5, 51, seed=1), 1e-3)
    monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=0))
    with pytest.raises(MemoryError, match=r"^contact of a map of \(51, 51\) heights takes"):
        solver.solve_complete_contact()
