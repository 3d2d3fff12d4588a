"""Compare every method with exact solutions: errors and observed orders on grids from coarse to fine.

The bodies have exact solutions (viscorough.reference) and are discretized by n elements across L = 1. The elements are
squares, except for a second sphere with twice as many columns. An error is the root mean square of the relative
deviation from the exact value at several contact radii, since at a single radius the error oscillates with the position
of the contact edge in the grid. For the same reason, flat ellipses have several sizes. The observed order is the slope
of ln(error) as a function of ln(1/n). Boundary elements are solved to such a small tolerance that the error of the grid
dominates.
"""

import numpy as np
import pandas as pd

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.mdr import reduce
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import cut_disc, self_affine_disc
from viscorough.viscous.integration.events import newtonian_events
from viscorough.viscous.kinetics import kinetics

BODIES = {"sphere": reference.sphere(1.0), "cone": reference.cone(0.1)}
RADII = np.linspace(0.2, 0.45, 26)  # contact radii of the comparison, in units of L
# Major semi-axes of the flat ellipses, in units of L. Each minor semi-axis is half as long.
ELLIPSES = np.linspace(0.3, 0.5, 11)
# Force F and viscosity η of the viscous comparisons. F/η is far from 1, so an error in the use of F or η would show.
FORCE, VISCOSITY = 10.0, 1e6
TOLERANCE = 1e-5  # tolerance of the contact problems with sphere, cone and flat punches
ROUGH = {"hurst": 0.7, "seed": 1}  # arguments of self_affine_disc for the rough disc
# Direct integration of the rough disc ends after this many contact events; more events would add no information.
EVENTS = 600
EVENTS_APART = 20  # depths are compared at every twentieth contact event
CORRESPONDENCE_TOLERANCE = 1e-11  # tolerance of the elastic curve that is compared with direct integration

# Expected orders of convergence. Boundary elements have uniform pressure and are collocated at their centres. On a
# smooth body their error in force is of second order. Errors of stiffnesses are of first order, because of the singular
# pressure at the edge of a flat punch, and so are errors of areas, which are counts of elements. Depth and velocity at
# a given impulse have the orders of force and stiffness. Direct integration and the correspondence principle are both
# exact on the same grid, so their deviation has the order 0.
ORDERS = {"force": 2, "depth": 2, "stiffness": 1, "velocity": 1, "area": 1, "punch_stiffness": 1, "correspondence": 0}
GRIDS_FOR_ORDER = 3  # an order of convergence is fitted only to at least this number of grids

COLUMNS = {
    "comparison": ("body and method", ""),
    "quantity": ("quantity compared with the exact solution", ""),
    "elements": ("elements across the body", "1"),
    "error": ("relative error, root mean square over contact radii, of ellipses over sizes", "1"),
    "order": ("observed order of convergence over all grids", "1"),
    "expected_order": ("expected order of convergence; 0: exact on any grid", "1"),
    "limit": ("largest error allowed on the finest grid", "1"),
    "passed": ("1 if the error and the order of this comparison and quantity are within their limits", "1"),
}


def validation_table(elements, limits, order_margin):
    """Return errors and observed orders of convergence of every comparison (body and method) on every grid.

    elements : numbers of elements n across L, each at least 9
    limits : {quantity: largest relative error allowed on the finest grid}, for all quantities in `ORDERS`
    order_margin : the observed order may lie below the expected order by at most this amount

    Returns a pandas.DataFrame with the columns of `COLUMNS`: one row per comparison, quantity and grid, from coarse to
    fine. `passed` is 1 if the error on the finest grid is within its limit and, for three grids or more, the order is
    high enough.
    """
    errors = [
        (comparison, quantity, n, error)
        for n in sorted(elements)
        for comparison, quantities in _errors_on_grid(n)
        for quantity, error in quantities.items()
    ]
    return judge_errors(pd.DataFrame(errors, columns=list(COLUMNS)[:4]), limits, order_margin)


def judge_errors(errors, limits, order_margin):
    """Fit orders of convergence to given errors; return the table of `validation_table`, with the column `passed`.

    errors : table with the columns of `COLUMNS` up to "error". The rows of one comparison (body and method) and one
        quantity are sorted from coarse to fine grids
    limits, order_margin : arguments of `validation_table`
    """
    judged = []
    for (_, quantity), rows in errors.groupby(["comparison", "quantity"], sort=False):
        order, expected = np.nan, ORDERS[quantity]
        if len(rows) >= GRIDS_FOR_ORDER and expected > 0:
            order = -np.polyfit(np.log(rows["elements"]), np.log(rows["error"]), 1)[0]
        passed = rows["error"].iloc[-1] <= limits[quantity] and not order < expected - order_margin
        judged.append(rows.assign(order=order, expected_order=expected, limit=limits[quantity], passed=int(passed)))
    return pd.concat(judged, ignore_index=True)


def failures(table, order_margin):
    """Return one line of text for each comparison (body and method) and quantity that failed in a validation table.

    The line states the error, the observed order, and the limits of both.
    """
    finest = table[(table["passed"] == 0) & (table["elements"] == table["elements"].max())]
    return [
        f"{row.comparison} {row.quantity}: error {row.error:.2g} on {row.elements} elements, order {row.order:.2g}; "
        f"allowed: error up to {row.limit:.2g}, order from {row.expected_order - order_margin:.2g}"
        for row in finest.itertuples()
    ]


def _errors_on_grid(n):
    """Yield (name of the comparison, {quantity: error}) for every body and method, with n elements across L."""
    for name, body in BODIES.items():
        indenter = body.indenter(n)
        yield name, _indentation(indenter, body)
        for history, errors in _penetration(indenter, body):
            yield f"{name}_{history}_force", errors
        yield f"{name}_reduction", _reduction(body.mdr_line(n), body)
    yield "sphere_on_rectangles", _indentation(BODIES["sphere"].indenter(2 * n, rows=n), BODIES["sphere"])
    yield from _flat_punches(n)
    yield "rough_disc", {"correspondence": _correspondence(self_affine_disc(elements_across=n, **ROUGH))}


def _flat_punches(n):
    """Yield (name of the comparison, {quantity: error}) for the stiffness of a flat disc and of flat ellipses.

    The flat disc has the same elements as a rough disc with n elements across.
    """
    disc = Indenter(cut_disc(np.zeros((n, n)), n), 1 / n)
    x = (np.arange(n) - (n - 1) / 2) / n
    ellipses = [Indenter(np.where((2 * x[:, None]) ** 2 + x**2 <= major**2, 0.0, np.nan), 1 / n) for major in ELLIPSES]
    stiffness = [indent(punch, tolerance=TOLERANCE).stiffness[0] for punch in (disc, *ellipses)]
    exact = reference.flat_ellipse_stiffness(ELLIPSES, ELLIPSES / 2)
    yield "disc", {"punch_stiffness": _error(stiffness[0], reference.flat_disc_stiffness(0.5))}
    yield "ellipse", {"punch_stiffness": _error(np.array(stiffness[1:]), exact)}


def _correspondence(disc):
    """Return the deviation of direct integration from the correspondence principle, for a rough disc.

    The elastic problem gives F/G at several depths. By the principle, the viscous disc reaches these depths when the
    impulse ∫F dt/η equals F/G. The result is the relative deviation of the depths by direct integration at these
    impulses.
    """
    events = newtonian_events(disc, until_fraction=min(1.0, EVENTS / disc.elements))
    depth = np.unique(events.depth[1:])[::EVENTS_APART]
    elastic = indent(disc, depths=depth, tolerance=CORRESPONDENCE_TOLERANCE)
    return _error(events.depth_at(elastic.force), depth)


def _indentation(indenter, body):
    """Return the errors of force, stiffness and contact area by boundary elements.

    The depths are the exact depths for the contact radii `RADII`.
    """
    depth = body.mdr_profile(RADII)
    curve = indent(indenter, depths=depth, tolerance=TOLERANCE)
    return {
        "force": _error(curve.force, body.force(depth)),
        "stiffness": _error(curve.stiffness, body.stiffness(depth)),
        "area": _error(curve.contact_count * indenter.element_side**2, np.pi * RADII**2),
    }


def _penetration(indenter, body):
    """Yield (force history, {quantity: error}) for viscous motions computed from a loading curve.

    `indent` chooses the depths of the curve. The force history "constant" is F = FORCE up to the time T. The force
    history "rising" is F(t) = 2 FORCE t/T, with the same impulse ∫F dt at T.
    """
    loading = body.force(body.mdr_profile(RADII))  # values of F/G, used also as values of the impulse ∫F dt/η
    curve = indent(indenter, tolerance=TOLERANCE, until_force=1.01 * loading[-1])
    depth = body.depth(loading)
    times = np.append(0, loading * VISCOSITY / FORCE)
    rising_times = np.sqrt(times * times[-1])
    rising_force = 2 * FORCE * rising_times / times[-1]
    for history, force, at in (("constant", FORCE, times), ("rising", rising_force, rising_times)):
        motion = kinetics(curve, force, VISCOSITY, at)
        velocity = np.broadcast_to(force, at.shape)[1:] / (VISCOSITY * body.stiffness(depth))
        yield history, {"depth": _error(motion.depth[1:], depth), "velocity": _error(motion.velocity[1:], velocity)}


def _reduction(line, body):
    """Return the errors of depth and stiffness by the MDR, at the exact forces for the contact radii `RADII`.

    line : line that is equivalent to the body
    """
    depth = body.mdr_profile(RADII)
    reduced_depth, stiffness = reduce(line).at_force(body.force(depth))
    return {"depth": _error(reduced_depth, depth), "stiffness": _error(stiffness, body.stiffness(depth))}


def _error(value, exact):
    """Return the root mean square of the relative deviation of values from exact values."""
    return float(np.sqrt(np.mean((value / exact - 1) ** 2)))
