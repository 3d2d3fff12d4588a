"""Errors over the number of steps, the width of the box and the range of the power law."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from viscorough.contact.loading_path import indent
from viscorough.contact.options import SolverOptions
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import cut_disc
from viscorough_study.robustness import knobs


def test_explicit_steps_converge_and_few_of_them_warn():
    rows = list(knobs._step_rows(1, 13))
    errors, warned = [row[3] for row in rows], [row[4] for row in rows]
    assert errors[0] > 0.05 > 0.01 > errors[-1]
    assert warned[0] == 1
    assert all(flag for error, flag in zip(errors, warned, strict=True) if error > 0.02)


def test_box_as_wide_as_the_map_is_the_solver_without_padding():
    across = 13
    flat = Indenter(cut_disc(np.zeros((across, across)), across), 1.0)
    stiffness = {}
    for padding in (True, False):
        options = SolverOptions(dense_contacts=0, dense_interactions=0, padding=padding)
        stiffness[padding] = indent(flat, depths=[1.0], tolerance=1e-8, options=options).stiffness[0]
    expected = stiffness[False] / stiffness[True]
    ratio = knobs.periodic_stiffness(across, across) / knobs.periodic_stiffness(across, 2 * across)
    assert ratio == pytest.approx(expected, rel=1e-6)
    assert abs(expected - 1) > 0.05


def test_power_law_has_the_error_of_its_departure_from_the_mean(monkeypatch):
    """Elements in region (a), where a single one touches, do not count."""
    x, law = np.array([1e-3, 1e-2, 1e-1]), pd.DataFrame({"beta": [0.3], "zeta": [0.9]}, index=[0.4])
    velocity = x**0.3 / 0.9 * [1.0, 1.0, 2.0]
    mean = xr.Dataset({"x": ("abscissa", x), "velocity_geometric": ("abscissa", velocity)})
    mean["contact_count_median"] = ("abscissa", [1, 5, 50])
    monkeypatch.setattr(knobs, "select", lambda pool, **wanted: pool)
    monkeypatch.setattr(knobs, "ensembles", lambda pool, *names, **wanted: {0.4: mean})
    monkeypatch.setattr(knobs, "fits", lambda *table, **wanted: law.rename_axis("hurst").reset_index())
    rows = list(knobs._range_rows(None, None, {"rms_convention": "disc"}))
    assert [row[2] for row in rows] == [1e-2, 1e-1]
    np.testing.assert_allclose([row[3] for row in rows], [0.0, 0.5], atol=1e-12)
