"""Elongated maps: a few rows or columns of many elements, which the grid solver treats differently from squares."""

import numpy as np
import pytest

from support.dense_contact import pressure_at_depth
from viscorough.contact.loading_path import indent
from viscorough.contact.options import SolverOptions
from viscorough.contact.solver import ContactSolver
from viscorough.indenter import Indenter

ON_THE_GRID = SolverOptions(dense_contacts=0, dense_interactions=0)


def strip(shape):
    return np.random.default_rng(1).random(shape)


def contact_of(heights, depth):
    solver = ContactSolver(Indenter(heights, 1.0), 1e-6, ON_THE_GRID)
    return solver.elements, solver.advance(solver.unloaded_state(), depth)


@pytest.mark.parametrize("shape", [(1, 170), (2, 85), (3, 57), (9, 38), (170, 1), (57, 3)])
def test_pressure_is_that_of_a_dense_solver(shape):
    heights, depth = strip(shape), 1.2
    elements, contact = contact_of(heights, depth)
    pressure = np.zeros(shape)
    pressure[tuple(place[contact.members] for place in elements.map_place)] = contact.pressure
    expected = pressure_at_depth(heights.max() - heights, depth, contact_modulus=4.0)  # E* = 4G: pressures over G
    assert 0.3 < np.mean(expected > 0) < 1
    np.testing.assert_allclose(pressure, expected, atol=1e-5 * expected.max())


def test_orientation_of_a_strip_of_rectangles_does_not_matter():
    """The grid of a tall strip is transposed, and with it the aspect of the elements."""
    contacts = []
    for heights, sides in ((strip((3, 57)), (1.0, 4.0)), (strip((3, 57)).T, (4.0, 1.0))):
        solver = ContactSolver(Indenter(heights, sides), 1e-6, ON_THE_GRID)
        contacts.append(solver.advance(solver.unloaded_state(), 0.8))
    assert contacts[0].force == pytest.approx(contacts[1].force, rel=1e-9)
    np.testing.assert_array_equal(np.sort(contacts[0].members), np.sort(contacts[1].members))


def test_a_long_strip_meets_complementarity():
    """Its curve starts with contact events and goes on where blocks of blocks of the preconditioner are needed."""
    heights = strip((1, 6000))
    curve = indent(Indenter(heights, 1.0), until_fraction=0.5)
    assert curve.contact_fraction[-1] >= 0.5
    elements, contact = contact_of(heights, curve.depth[-1])
    pressure = np.zeros(6000)
    pressure[elements.map_place[1][contact.members]] = contact.reduced_pressure
    deflection = np.convolve(pressure, elements.influence[0, abs(np.arange(-5999, 6000))])[5999:11999]
    gap = deflection - contact.reduced_depth + (heights.max() - heights[0]) / contact.units.length
    residual = max(abs(gap[pressure > 0]).max(), -gap.min()) / contact.reduced_depth
    assert residual <= contact.residual <= 1e-6
    assert curve.force[-1] == pytest.approx(contact.force, rel=1e-5)
    assert curve.stiffness[-1] == pytest.approx(contact.stiffness, rel=1e-3)
