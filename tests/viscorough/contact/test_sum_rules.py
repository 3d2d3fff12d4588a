"""Two integrals of loading curves have the exact values that linear solutions give."""

from dataclasses import replace

import numpy as np
import pytest

from support.influence import influence_matrix
from support.sum_rules import audit, integrals
from viscorough import Indenter, SolverOptions, indent, reduce
from viscorough.contact.complete_contact import CompleteContact, complete_contact
from viscorough.reference import cone, sphere
from viscorough.surfaces.self_affine import cut_disc, self_affine_disc, self_affine_line, self_affine_square

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


@pytest.mark.parametrize("indenter", INDENTERS.values(), ids=INDENTERS)
def test_integrals_are_exact_if_every_event_is_a_level(indenter):
    result = audit(indenter, tolerance=1e-10)
    assert result.agrees
    assert result.rules.largest_deviation < 1e-11
    assert result.curve.contact_count[-1] == indenter.elements


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


@pytest.mark.parametrize(
    ("hurst", "across", "tolerance", "levels"), [(0.2, 65, 1e-3, 600), (0.6, 49, 1e-3, 600), (0.6, 49, 2e-4, 1000)]
)
def test_audit_on_the_grid_adds_levels_until_both_integrals_converge(hurst, across, tolerance, levels):
    disc = self_affine_disc(hurst, across, seed=1)
    result = audit(disc, tolerance=tolerance)
    assert result.agrees
    assert abs(result.rules.first.deviations["last level"]) < 1e-7
    assert result.curve.depth.size < levels
    plain = integrals(indent(disc, until_fraction=1.0), result.complete)
    assert plain.largest_deviation > 5 * result.rules.largest_deviation


@pytest.mark.parametrize("body", [sphere, cone])
def test_audit_of_a_body_confirms_the_accuracy_of_interpolation(body):
    """On smooth bodies many elements touch between two levels, so the error bound alone places most levels."""
    result = audit(body(1.0).indenter(65), tolerance=1e-3)
    assert result.agrees
    assert 0.1 < result.interpolation_error / result.curve.tolerance < 1


WRONG = {
    "stiffness": lambda curve: {"stiffness": curve.stiffness * 1.001},
    "stiffness of one level": lambda curve: {"stiffness": curve.stiffness * (1 + 0.1 * (np.arange(197) == 50))},
    "depth": lambda curve: {"depth": curve.depth * 1.001},
    "force": lambda curve: {"force": curve.force * (1 + 1e-3 * (curve.contact_count < 100))},
    "missing levels": lambda curve: {
        name: getattr(curve, name)[::7] for name in ("depth", "force", "stiffness", "contact_count", "residual")
    },
}


@pytest.mark.parametrize("change", WRONG.values(), ids=WRONG)
def test_wrong_curve_has_wrong_integrals(change):
    indenter = self_affine_disc(0.8, 17, seed=1)
    curve, end = indent(indenter, until_fraction=1.0), complete_contact(indenter)
    assert integrals(curve, end).largest_deviation < 1e-11
    rules = integrals(replace(curve, **change(curve)), end)
    assert max(rules.largest_deviation, rules.error) > 2e-5


def test_audit_disagrees_if_levels_do_not_reduce_the_error():
    """Without padding, the images of the indenter change stiffness and depth alike. Only the exact values reveal it."""
    options = SolverOptions(dense_contacts=0, dense_interactions=0, padding=False)
    result = audit(self_affine_disc(0.6, 33, seed=1), tolerance=3e-3, options=options)
    assert not result.agrees


def test_audit_requires_the_curve_tolerance_between_levels():
    """The required accuracy is the tolerance of the curve, but at least 1e-5, the finest tolerance of `indent`."""
    whole = audit(INDENTERS["sphere"], tolerance=1e-3)
    for tolerance, promised in ((1e-2, 1e-2), (1e-5, 1e-5), (1e-9, 1e-5)):
        result = replace(whole, curve=replace(whole.curve, tolerance=tolerance))
        for error, agrees in ((0.99 * promised, True), (1.01 * promised, False)):
            judged = replace(result, interpolation_error=error)
            assert (judged.is_interpolated, judged.agrees) == (agrees, agrees)
    assert not replace(whole, tolerance=1e-20).agrees


def test_integrals_of_independent_springs_are_exact():
    """On a line, ⟨g⟩ is the plain mean of the gaps, and U/G = 2 Δx Σ (g − ⟨g⟩)²."""
    line = self_affine_line(0.7, 3000, seed=3, dtype=np.float64)
    gap, punch = line.initial_gap, 4 * line.spacing * line.elements
    end = CompleteContact(gap.mean(), punch / 2 * gap.var(), punch, gap.max())
    curve = reduce(line)
    np.testing.assert_allclose([curve.stiffness[-1], curve.depth[-1]], [end.stiffness, end.depth], rtol=0.016)
    rules = integrals(curve, end)
    assert rules.largest_deviation < 1e-3
    assert abs(rules.first.deviations["last level"]) < 1e-12


def test_indenter_of_one_height_has_integrals_of_zero():
    result = audit(Indenter(np.full((3, 4), 2.0), 0.5))
    assert result.agrees
    assert (result.complete.mean_gap, result.complete.energy, result.complete.force) == (0, 0, 0)
