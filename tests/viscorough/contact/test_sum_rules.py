"""Two integrals of loading curves have the exact values that linear solutions give.

If all elements are joined to the surface, F = k_c (u − ⟨g₀⟩). The curve of the contact ends on this line, so that

    ∫₀^∞ (1/k − 1/k_c) dF = ⟨g₀⟩        ∫₀^∞ (⟨g₀⟩ + F/k_c − u) dF = U

with the elastic energy U of the joined surface at zero mean force (viscorough.contact.complete_contact).
"""

import numpy as np
import pytest

from support.influence import influence_matrix
from viscorough import Indenter, indent, reduce
from viscorough.contact.complete_contact import CompleteContact, complete_contact
from viscorough.reference import cone, sphere
from viscorough.surfaces.lines import self_affine_line
from viscorough.surfaces.self_affine import cut_disc, self_affine_disc, self_affine_square

SMALL = 18  # elements across, at most 400 in all: every contact event is a level
ROUGH = cut_disc(self_affine_square(0.1, SMALL, seed=4), SMALL)


def with_hole(heights):
    row, column = np.indices(heights.shape)
    return np.where((abs(row - 7) < 3) & (abs(column - 10) < 2), np.nan, heights)


INDENTERS = {
    **{f"H = {hurst:g}": self_affine_disc(hurst, SMALL, seed=4) for hurst in (0.1, 0.4, 0.6, 0.9)},
    "sphere": sphere(1.0).indenter(SMALL),
    "cone": cone(0.3).indenter(SMALL),
    "terraces": Indenter(np.round(2 * ROUGH), 0.1),
    "hole": Indenter(with_hole(ROUGH), 1.0),
    "rectangles": Indenter(ROUGH, 0.3, 1.2),
    "a strip": Indenter(ROUGH[8:10], 0.5),
    "far units": Indenter(1e-9 * ROUGH, 1e6),
}


def integrals(curve, end):
    """Return both integrals over their exact values, by trapezoids of the interpolated curve."""
    share = np.linspace(0, 1, 20, endpoint=False)
    force = np.append((curve.force[:-1, None] + np.diff(curve.force)[:, None] * share).ravel(), curve.force[-1])
    depth, stiffness = curve.at_force(force)
    start = curve.depth[0] - curve.force[0] / end.stiffness, (end.mean_gap - 0.5 * curve.depth[0]) * curve.force[0]
    first = start[0] + np.trapezoid(1 / stiffness - 1 / end.stiffness, force)
    second = start[1] + curve.force[0] ** 2 / (2 * end.stiffness)
    second += np.trapezoid(end.mean_gap + force / end.stiffness - depth, force)
    return first / end.mean_gap, second / end.energy


@pytest.mark.filterwarnings("ignore:.*larger than the map is wide")
@pytest.mark.parametrize("indenter", INDENTERS.values(), ids=INDENTERS)
def test_integrals_are_exact_if_every_event_is_a_level(indenter):
    """Between the events the curve is straight, with the stiffness of the event before."""
    curve, end = indent(indenter, tolerance=1e-10, until_fraction=1.0), complete_contact(indenter)
    assert curve.contact_count[-1] == indenter.elements
    np.testing.assert_allclose(np.diff(curve.force), curve.stiffness[:-1] * np.diff(curve.depth), rtol=1e-8)
    assert integrals(curve, end)[1] == pytest.approx(1, rel=1e-10)


@pytest.mark.parametrize(
    "indenter", [self_affine_disc(0.2, 65, seed=1), sphere(1.0).indenter(65)], ids=["disc", "sphere"]
)
def test_integrals_of_a_curve_on_the_grid_are_exact_to_its_tolerance(indenter):
    curve, end = indent(indenter, tolerance=1e-4, until_fraction=1.0), complete_contact(indenter)
    assert integrals(curve, end) == pytest.approx((1, 1), rel=5e-3)


@pytest.mark.parametrize("aspect", [1.0, 2.5])
def test_solution_on_the_grid_agrees_with_the_dense_matrix(aspect):
    heights = with_hole(cut_disc(self_affine_square(0.3, 33, seed=1), 33)[:, :25])
    indenter = Indenter(heights, 0.1, 0.1 * aspect)
    row, column = np.nonzero(~np.isnan(heights))
    assert row.size > 400
    matrix = influence_matrix(row, column, aspect) / (4 * np.pi * indenter.element_side)
    gap = np.nanmax(heights) - heights[row, column]
    tangent, load = np.linalg.solve(matrix, np.ones(gap.size)), np.linalg.solve(matrix, gap)
    mean_gap = tangent @ gap / tangent.sum()
    energy = (load - mean_gap * tangent) @ matrix @ (load - mean_gap * tangent) / 2  # energy of the pressures
    end = complete_contact(indenter)
    exact = [mean_gap, energy, tangent.sum(), (load / tangent).max()]
    np.testing.assert_allclose([end.mean_gap, end.energy, end.stiffness, end.depth], exact, rtol=1e-10)


def test_integrals_of_independent_springs_are_exact():
    """On a line, ⟨g⟩ is the plain mean of the gaps, and U/G = 2 Δx Σ (g − ⟨g⟩)²."""
    line = self_affine_line(0.7, 3000, seed=3, dtype=np.float64)
    gap, punch = line.initial_gap, 4 * line.spacing * line.elements
    end = CompleteContact(gap.mean(), punch / 2 * gap.var(), punch, gap.max())
    curve = reduce(line)
    np.testing.assert_allclose([curve.stiffness[-1], curve.depth[-1]], [end.stiffness, end.depth], rtol=0.016)
    assert integrals(curve, end) == pytest.approx((1, 1), rel=5e-3)
