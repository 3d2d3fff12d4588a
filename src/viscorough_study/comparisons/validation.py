"""Compare every method with exact solutions: errors and observed orders on grids from coarse to fine.

The bodies have exact solutions (viscorough.reference) and are discretized by n elements across L = 1. The elements are
squares, except for a second sphere with twice as many columns. Errors are root mean squares, over a range of contact
radii, of the relative deviation from the exact value: at a single radius the error oscillates with the position of the
contact edge in the grid. For the same reason there are flat ellipses of several sizes. The observed order is the slope
of ln(error) over ln(1/n). Boundary elements are solved to a tolerance so small that the error of the grid dominates.
"""

import numpy as np
import pandas as pd

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.mdr import reduce
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import cut_disc, self_affine_disc
from viscorough.viscous.integration.events import march_events
from viscorough.viscous.kinetics import kinetics

BODIES = {"sphere": reference.sphere(1.0), "cone": reference.cone(0.1)}
RADII = np.linspace(0.2, 0.45, 26)  # contact radii for the comparison of solutions [L]
ELLIPSES = np.linspace(0.3, 0.5, 11)  # major semi-axes of the flat ellipses [L]; the minor ones are half as long
FORCE, VISCOSITY = 10.0, 1e6  # force and viscosity of the viscous cases; F/η is far from 1, so a missing F or η shows
TOLERANCE = 1e-5  # tolerance of the contact problems on bodies and punches
ROUGH = {"hurst": 0.7, "seed": 1}  # arguments of self_affine_disc
EVENTS = 600  # contact events of the direct integration of a rough disc; more would add no information
EVENTS_APART = 20  # the depth at every twentieth of these events is compared
CORRESPONDENCE_TOLERANCE = 1e-11  # tolerance of the elastic curve compared with direct integration

# Uniform pressure on elements, collocated at their centres, has an error of second order in force on a smooth body, and
# of first order if an edge singularity or a count of elements enters. Depth and velocity at a given impulse inherit the
# orders of force and stiffness. Direct integration and the correspondence are both exact on the same grid.
ORDERS = {"force": 2, "depth": 2, "stiffness": 1, "velocity": 1, "area": 1, "punch_stiffness": 1, "correspondence": 0}
GRIDS_FOR_ORDER = 3  # smallest number of grids for an order

COLUMNS = {
    "case": ("body and method", ""),
    "quantity": ("quantity compared with the exact solution", ""),
    "elements": ("elements across the body", "1"),
    "error": ("relative error, root mean square over contact radii, of ellipses over sizes", "1"),
    "order": ("observed order of convergence over all grids", "1"),
    "expected_order": ("expected order of convergence; 0: exact on any grid", "1"),
    "limit": ("largest error allowed on the finest grid", "1"),
    "passed": ("1 if the error and the order of this case and quantity are within their limits", "1"),
}


def validation_table(elements, limits, order_margin):
    """Return the errors of every case on every grid.

    elements : numbers of elements n across L, each at least 9
    limits : {quantity: largest relative error allowed on the finest grid}, one for each of `ORDERS`
    order_margin : largest amount by which an observed order may be below the expected one

    Returns a pandas.DataFrame with the columns of `COLUMNS`: one row per case, quantity and grid, grids from coarse to
    fine. `passed` is 1 if the error on the finest grid is within its limit and, for three grids or more, the order is
    within the margin.
    """
    errors = [
        (case, quantity, n, error)
        for n in sorted(elements)
        for case, quantities in _errors_on_grid(n)
        for quantity, error in quantities.items()
    ]
    return judge_errors(pd.DataFrame(errors, columns=list(COLUMNS)[:4]), limits, order_margin)


def judge_errors(errors, limits, order_margin):
    """Return the validation table of errors; limits, order_margin : as in validation_table

    errors : its columns up to the error, grids from coarse to fine
    """
    judged = []
    for (_, quantity), rows in errors.groupby(["case", "quantity"], sort=False):
        order, expected = np.nan, ORDERS[quantity]
        if len(rows) >= GRIDS_FOR_ORDER and expected > 0:
            order = -np.polyfit(np.log(rows["elements"]), np.log(rows["error"]), 1)[0]
        passed = rows["error"].iloc[-1] <= limits[quantity] and not order < expected - order_margin
        judged.append(rows.assign(order=order, expected_order=expected, limit=limits[quantity], passed=int(passed)))
    return pd.concat(judged, ignore_index=True)


def failures(table, order_margin):
    """Return one line per failed case and quantity of a validation table: its error and order, and the limits."""
    finest = table[(table["passed"] == 0) & (table["elements"] == table["elements"].max())]
    return [
        f"{row.case} {row.quantity}: error {row.error:.2g} on {row.elements} elements, order {row.order:.2g}; "
        f"allowed: error up to {row.limit:.2g}, order from {row.expected_order - order_margin:.2g}"
        for row in finest.itertuples()
    ]


def _errors_on_grid(n):
    """Yield every case with {quantity: error} for n elements across L."""
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
    """Yield errors of the stiffness of a flat disc, on the grid of the rough discs, and of flat ellipses."""
    disc = Indenter(cut_disc(np.zeros((n, n)), n), 1 / n)
    x = (np.arange(n) - (n - 1) / 2) / n
    ellipses = [Indenter(np.where((2 * x[:, None]) ** 2 + x**2 <= major**2, 0.0, np.nan), 1 / n) for major in ELLIPSES]
    stiffness = [indent(punch, tolerance=TOLERANCE).stiffness[0] for punch in (disc, *ellipses)]
    exact = reference.flat_ellipse_stiffness(ELLIPSES, ELLIPSES / 2)
    yield "disc", {"punch_stiffness": _error(stiffness[0], reference.flat_disc_stiffness(0.5))}
    yield "ellipse", {"punch_stiffness": _error(np.array(stiffness[1:]), exact)}


def _correspondence(disc):
    """Return the error of the elastic depths under the impulses of contact events, against direct integration."""
    events = march_events(disc, until_fraction=min(1.0, EVENTS / disc.elements))
    depth = np.unique(events.depth[1:])[::EVENTS_APART]
    elastic = indent(disc, depths=depth, tolerance=CORRESPONDENCE_TOLERANCE)
    return _error(events.depth_at(elastic.force), depth)


def _indentation(indenter, body):
    """Return errors of boundary elements at given depths against the elastic solution."""
    depth = body.mdr_profile(RADII)
    curve = indent(indenter, depths=depth, tolerance=TOLERANCE)
    return {
        "force": _error(curve.force, body.force(depth)),
        "stiffness": _error(curve.stiffness, body.stiffness(depth)),
        "area": _error(curve.contact_count * indenter.element_side**2, np.pi * RADII**2),
    }


def _penetration(indenter, body):
    """Yield force histories and errors of the correspondence on a curve with automatic levels.

    Constant force: F = FORCE. Rising force: F(t) = 2 FORCE t/T until T, with the same impulse at T.
    """
    loading = body.force(body.mdr_profile(RADII))  # F/G, and impulse over viscosity
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
    """Return errors of the line of the MDR, at given forces, against the elastic solution."""
    depth = body.mdr_profile(RADII)
    reduced_depth, stiffness = reduce(line).at_force(body.force(depth))
    return {"depth": _error(reduced_depth, depth), "stiffness": _error(stiffness, body.stiffness(depth))}


def _error(value, exact):
    """Return the root mean square of the relative deviation."""
    return float(np.sqrt(np.mean((value / exact - 1) ** 2)))
