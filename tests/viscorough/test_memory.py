"""Problems too large for the available memory are refused before anything is allocated."""

from types import SimpleNamespace

import numpy as np
import psutil
import pytest

from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
from viscorough.surfaces import self_affine_disc, self_affine_line


@pytest.mark.parametrize(
    ("make", "what"),
    [
        (lambda: self_affine_disc(0.5, 20_001 * 8, seed=1), "a surface of 160008 x 160008 points takes"),
        (lambda: self_affine_line(0.5, 10**14, seed=1), "a line of 100000000000000 points takes"),
    ],
)
def test_surfaces_too_large_for_any_memory_are_refused(make, what):
    """Sizes for which no machine has the memory."""
    with pytest.raises(MemoryError, match=rf"{what} .* bytes of memory, .* bytes are available"):
        make()


def test_a_map_too_large_to_press_is_refused(monkeypatch):
    monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=1_000_000))
    indent(Indenter(np.zeros((20, 20)), 1.0))
    with pytest.raises(MemoryError, match=r"contact of a map of \(60, 60\) heights takes 1\.44e\+06 bytes of memory"):
        indent(Indenter(np.zeros((60, 60)), 1.0))
