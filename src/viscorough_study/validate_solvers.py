"""Validation: errors and observed orders of every method against exact solutions, on the grids in use.

The bodies have exact solutions (viscorough.reference) and stand on grids of n elements across L = 1. Errors are root
mean squares, over a range of contact radii, of the relative deviation from the exact value: at one radius alone they
oscillate with how the circle of contact happens to cut the grid. The observed order is the slope of ln(error) over
ln(1/n). Boundary elements are solved to a tolerance at which what is left is the error of the grid.
"""

import numpy as np
import pandas as pd

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
from viscorough.mdr import reduce
from viscorough.surfaces import cut_disc, self_affine_disc
from viscorough.viscous.correspondence import kinetics
from viscorough.viscous.events import march_events

BODIES = {"sphere": reference.sphere(1.0), "cone": reference.cone(0.1)}
RADII = np.linspace(0.2, 0.45, 26)  # contact radii at which solutions are compared [L]
SEMI_AXES = {"disc": (0.5, 0.5), "ellipse": (0.5, 0.25)}  # of the flat punches [L]
FORCE, VISCOSITY = 10.0, 1e6  # of the viscous cases; F/η is far from 1, so that neither drops out by chance
TOLERANCE = 1e-5

# Uniform pressure on square elements, met at their centres, has an error of second order in force on a smooth body,
# and of first order where an edge singularity or a count of elements enters. Depth and velocity at a given impulse
# inherit that of force and of stiffness. The error of an ellipse changes sign on the way: no order to be observed.
# Direct integration of the viscous problem and the correspondence are both exact on the same grid: no order at all.
ORDERS = {"force": 2, "depth": 2, "stiffness": 1, "velocity": 1, "area": 1, "punch_stiffness": 1, "correspondence": 0}
WITHOUT_ORDER = ("ellipse", "rough_disc")
ROUGH = {"hurst": 0.7, "seed": 1}  # arguments of self_affine_disc
EVENTS = 600  # contact events over which a rough disc is integrated directly
ORDER_MARGIN = 0.3  # by which an observed order may fall short of the expected one

COLUMNS = {
    "case": ("body and method", ""),
    "quantity": ("quantity compared with the exact solution", ""),
    "elements": ("elements across the body", "1"),
    "error": ("relative error, root mean square over contact radii", "1"),
    "order": ("observed order of convergence over all grids", "1"),
    "expected_order": ("expected order of convergence; 0: exact on any grid", "1"),
    "limit": ("largest error allowed on the finest grid", "1"),
    "passed": ("1 if the error and the order of this case and quantity are within their limits", "1"),
}


def validation_table(elements, limits):
    """Errors of every case on every grid.

    elements : numbers of elements n across L, each at least 9
    limits : {quantity: largest relative error allowed on the finest grid}, one for each of `ORDERS`

    Returns a pandas.DataFrame with the columns of `COLUMNS`: a row per case, quantity and grid, grids from coarse to
    fine. `passed` tells whether the case's error on the finest grid is within its limit and, where three grids or
    more allow one to be observed, its order no more than `ORDER_MARGIN` below the expected one.
    Raises ValueError if the limits are not those of `ORDERS`.
    """
    if set(limits) != set(ORDERS):
        raise ValueError(f"limits of validation: {', '.join(limits)}; needed: {', '.join(ORDERS)}")
    grids = sorted(elements)
    errors = {}
    for n in grids:
        for case, quantities in _errors_on_grid(n).items():
            for quantity, error in quantities.items():
                errors.setdefault((case, quantity), []).append(error)
    rows = []
    for (case, quantity), on_grids in errors.items():
        order, expected = np.nan, ORDERS[quantity]
        if len(grids) >= 3 and case not in WITHOUT_ORDER:
            order = -np.polyfit(np.log(grids), np.log(on_grids), 1)[0]
        limit = limits[quantity]
        passed = on_grids[-1] <= limit and not order < expected - ORDER_MARGIN
        for n, error in zip(grids, on_grids, strict=True):
            rows.append((case, quantity, n, error, order, expected, limit, int(passed)))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def failures(table):
    """One line per case and quantity of a validation table that did not pass: its error and order, what is allowed."""
    finest = table[(table["passed"] == 0) & (table["elements"] == table["elements"].max())]
    return [
        f"{row.case} {row.quantity}: error {row.error:.2g} on {row.elements} elements, order {row.order:.2g}; "
        f"allowed: error up to {row.limit:.2g}, order from {row.expected_order - ORDER_MARGIN:.2g}"
        for row in finest.itertuples()
    ]


def _errors_on_grid(n):
    """{case: {quantity: error}} for n elements across L."""
    cases = {}
    for name, body in BODIES.items():
        indenter = body.indenter(n)
        cases[name] = _indentation(indenter, body)
        cases |= {f"{name}_{history}_force": e for history, e in _penetration(indenter, body).items()}
        cases[f"{name}_reduction"] = _reduction(body.mdr_line(n), body)
    x = (np.arange(n) - (n - 1) / 2) / n
    for name, (major, minor) in SEMI_AXES.items():
        flat = np.where((x[:, None] / minor) ** 2 + (x / major) ** 2 <= 1, 0.0, np.nan)
        punch = Indenter(cut_disc(np.zeros((n, n)), n) if name == "disc" else flat, 1 / n)
        exact = reference.flat_ellipse_stiffness(major, minor)
        cases[name] = {"punch_stiffness": _error(indent(punch, tolerance=TOLERANCE).stiffness, exact)}
    cases["rough_disc"] = {"correspondence": _correspondence(self_affine_disc(elements_across=n, **ROUGH))}
    return cases


def _correspondence(disc):
    """Depths at which elements touch, integrated event by event, against the elastic depths under the same impulse."""
    events = march_events(disc, until_fraction=min(1.0, EVENTS / disc.elements))
    depth = np.unique(events.depth[1:])[::20]
    elastic = indent(disc, depths=depth, tolerance=1e-11)
    return _error(events.depth_at(elastic.force), depth)


def _indentation(indenter, body):
    """Boundary elements at given depths against the elastic solution."""
    depth = body.mdr_profile(RADII)
    curve = indent(indenter, depths=depth, tolerance=TOLERANCE)
    return {
        "force": _error(curve.force, body.force(depth)),
        "stiffness": _error(curve.stiffness, body.stiffness(depth)),
        "area": _error(curve.contact_count * indenter.spacing**2, np.pi * RADII**2),
    }


def _penetration(indenter, body):
    """The correspondence, on a curve with levels of its own choice, against the viscous solution.

    Constant force: F = FORCE. Rising force: F(t) = 2 FORCE t/T until T, with the same impulse at T.
    """
    loading = body.force(body.mdr_profile(RADII))  # F/G, and impulse over viscosity
    curve = indent(indenter, tolerance=TOLERANCE, until_force=1.01 * loading[-1])
    exact = body.depth(loading)
    times = loading * VISCOSITY / FORCE
    constant = kinetics(curve, FORCE, VISCOSITY, times)

    rising_times = np.append(0, np.sqrt(times * times[-1]))
    rising_force = 2 * FORCE * rising_times / times[-1]
    rising = kinetics(curve, rising_force, VISCOSITY, rising_times)
    stiffness = body.stiffness(exact)
    return {
        "constant": {
            "depth": _error(constant.depth, exact),
            "velocity": _error(constant.velocity, FORCE / (VISCOSITY * stiffness)),
        },
        "rising": {
            "depth": _error(rising.depth[1:], exact),
            "velocity": _error(rising.velocity[1:], rising_force[1:] / (VISCOSITY * stiffness)),
        },
    }


def _reduction(line, body):
    """The line of the reduction of dimensionality, at given forces, against the elastic solution."""
    depth = body.mdr_profile(RADII)
    reduced_depth, stiffness = reduce(line).at_force(body.force(depth))
    return {"depth": _error(reduced_depth, depth), "stiffness": _error(stiffness, body.stiffness(depth))}


def _error(value, exact):
    """Root mean square of the relative deviation."""
    return float(np.sqrt(np.mean((value / exact - 1) ** 2)))
