"""Rigid indenters."""

import numpy as np
import pytest

from viscorough.indenter import Indenter


def test_rms_slope_of_a_plane():
    x, y = np.mgrid[:5, :7]
    assert Indenter(0.6 * x + 1.6 * y, 2.0).rms_slope == pytest.approx(np.hypot(0.3, 0.8))
    assert Indenter(np.array([[1.0]]), 1.0).rms_slope == 0
