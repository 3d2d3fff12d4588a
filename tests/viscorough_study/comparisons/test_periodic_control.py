"""Contact on a periodic half-space, against the exact solution of a wavy surface."""

import numpy as np
import pytest

from viscorough.basics.errors import ConvergenceError
from viscorough_study.comparisons import periodic_control
from viscorough_study.comparisons.periodic_control import COLUMNS, mean_separations, periodic_contact

SETTINGS = {"surfaces": 3, "roll_off": {"wavelength": 0.25, "level": 1.0}, "per_decade": 4, "seed": 1}


def wave(points):
    """Return one wave of amplitude 1 across a square."""
    return np.tile(np.cos(2 * np.pi * np.arange(points) / points), (points, 1))


@pytest.mark.parametrize("share", [0.1, 0.5, 0.8])
def test_wavy_surface_follows_westergaard(share):
    """Westergaard: p/p* = sin²(πa) with the contact fraction a and p* = π E* amplitude/wavelength, up to the grid."""
    n, complete = 128, np.pi
    separation, pressure = periodic_contact(wave(n), np.full((n, n), share * complete), tolerance=1e-6)
    assert pressure.mean() == pytest.approx(share * complete)
    assert (pressure > 0).mean() == pytest.approx(2 / np.pi * np.arcsin(np.sqrt(share)), abs=2 / n)
    # The mean separation of a wavy surface under p = p* sin²(φ) is amplitude (cos²φ − sin²φ ln(1/sin²φ)) (Johnson
    # 1985).
    assert separation == pytest.approx(1 - share + share * np.log(share), abs=2e-3)


def test_complete_contact_has_no_separation():
    n = 32
    assert mean_separations(wave(n), np.sqrt(2) * np.pi * np.array([1.01, 2.0])) == pytest.approx([0, 0], abs=1e-4)


def test_table_has_a_row_for_each_pressure():
    table = periodic_control.periodic_control(hursts=[0.7], points=32, x_low=0.1, x_high=10.0, **SETTINGS)
    assert list(table) == list(COLUMNS)
    assert table["roll_off_wavelength"].isna().tolist() == [True] * 8 + [False] * 8
    assert (table["g_low"] < table["g"]).all()
    own, roll_off = table["g"][:8].to_numpy(), table["g"][8:].to_numpy()
    assert np.argmax(own) < 6, "contact becomes complete sooner without a roll-off"
    assert own[-1] < roll_off[-1]


def test_missing_convergence_raises(monkeypatch):
    monkeypatch.setattr(periodic_control, "ITERATIONS_MAX", 3)
    with pytest.raises(ConvergenceError, match="not reached in 3 iterations"):
        periodic_contact(wave(32), np.full((32, 32), 1.0))
