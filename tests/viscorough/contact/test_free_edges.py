"""Maps from files whose border carries much of the force are free-edged punches, which a warning states."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from viscorough import AccuracyWarning, Indenter, contact_at, indent, reference
from viscorough.basics.summaries import with_unit
from viscorough.surfaces.self_affine import self_affine_square

BORDER = "the border of the map carries more than 5 % of the force although less than 30 % of its elements touch"
FLAT = Indenter(0.01 * self_affine_square(0.8, 65, seed=1), 1 / 64, length_unit="m", from_file=True)
# The border lies far below the centre, where the sphere touches.
BALL = replace(reference.sphere(2.0).indenter(65), from_file=True)


@pytest.fixture
def caught():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield caught


@pytest.mark.parametrize("levels", [{}, {"depths": [0.01, 0.02]}, {"forces": [1e-3, 1e-2]}], ids=str)
def test_curve_of_a_flat_scan_states_the_depth(levels):
    with pytest.warns(AccuracyWarning, match=f"^from the depth u, .* mm, on, {BORDER}"):
        indent(FLAT, **levels)


def test_depth_is_that_from_which_on_the_border_carries_the_force(caught):
    """A border of lower elements touches last."""
    row, column = np.indices(FLAT.heights.shape)
    on_border = np.isin(row, (0, 64)) | np.isin(column, (0, 64))
    lowered = replace(FLAT, heights=FLAT.heights - 0.003 * on_border)
    contacts = contact_at(lowered, depth=np.linspace(0.004, 0.04, 10))
    shares = [contact.pressure[on_border].sum() / np.nansum(contact.pressure) for contact in contacts]
    first = next(contact for contact, share in zip(contacts, shares, strict=True) if share > 0.05)
    assert contacts[0] is not first
    (warning,) = caught
    assert f"from the depth u, {with_unit(first.depth, 'm')}, on" in str(warning.message)


def test_one_contact_of_a_flat_scan_is_a_warning():
    with pytest.warns(AccuracyWarning, match=f"^from the depth u, .*{BORDER}"):
        contact_at(FLAT, force=1e-2)


# A disc is a body whose edge is meant.
DISC = replace(FLAT, heights=np.where(np.hypot(*(np.indices((65, 65)) - 32)) < 8, FLAT.heights, np.nan))


@pytest.mark.parametrize("indenter", [BALL, DISC, replace(FLAT, from_file=False)], ids=["ball", "disc", "not a file"])
def test_other_bodies_give_no_warning(indenter, caught):
    indent(indenter, until_fraction=0.3)
    contact_at(indenter, depth=0.01)
    assert caught == []
