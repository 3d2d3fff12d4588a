"""Problems too large for the available memory are refused before anything is allocated."""

import json
import re
import tracemalloc
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import psutil
import pytest

from support.command_line import python
from viscorough import Indenter, indent, self_affine_disc, self_affine_line
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


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_memory_required_for_a_curve_is_that_of_its_arrays(tolerance, monkeypatch):
    """Large contacts take the most memory. The many levels of small contacts take most of the time of a whole curve."""
    indenter = Indenter(np.random.default_rng(1).random((300, 300)), 1.0)
    press = partial(indent, indenter, tolerance=tolerance, start_fraction=0.58, until_fraction=0.6)
    press()  # compiles the kernels
    tracemalloc.start()
    press()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < demand(press, monkeypatch) < 2 * peak


def test_complete_contact_too_large_for_the_memory_is_refused(monkeypatch):
    solver = ContactSolver(self_affine_disc(0.5, 51, seed=1), 1e-3)
    monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=0))
    with pytest.raises(MemoryError, match=r"^contact of a map of \(51, 51\) heights takes"):
        solver.solve_complete_contact()


# Prints the largest memory in bytes that the generation of lines takes, for each data type and number of points.
PEAKS_OF_LINES = r"""
import json, re, sys
from pathlib import Path
from viscorough.surfaces.self_affine import self_affine_line

def resident(what):
    return 1024 * int(re.search(what + r":\s+(\d+)", Path("/proc/self/status").read_text())[1])

peaks = []
for dtype in ("float64", "float32"):
    self_affine_line(0.5, 256, seed=1, dtype=dtype)  # loads compiled code
    for points in (2**20, 1_000_003, 2 * 500_009, 11 * 90_911):
        Path("/proc/self/clear_refs").write_text("5")  # the peak starts from the present memory
        before = resident("VmRSS")
        self_affine_line(0.5, points, seed=1, dtype=dtype)
        peaks.append((dtype, points, resident("VmHWM") - before))
print(json.dumps(peaks))
"""


@pytest.mark.skipif(not Path("/proc/self/clear_refs").exists(), reason="the peak of a process is read from /proc")
def test_memory_required_for_a_line_follows_its_transform(monkeypatch):
    """A length with a large prime factor takes up to eight times the memory of others.

    The test runs in a new process, because memory that other tests freed would be used again in this one. With this
    setting, the C library returns arrays above a size to the system as soon as they are freed.
    """
    for dtype, points, peak in json.loads(python("-c", PEAKS_OF_LINES, MALLOC_MMAP_THRESHOLD_="131072").stdout):
        required = demand(partial(self_affine_line, 0.5, points, seed=1, dtype=dtype), monkeypatch)
        assert peak < required
        if points == 1_000_003:
            assert required < 1.5 * peak
