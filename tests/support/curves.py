"""Loading curves of random numbers, for tests that write and read them."""

import dataclasses

import numpy as np

from viscorough.results.loading_curve import LoadingCurve


def random_curve(levels=7, seed=0, **changes):
    """Make a LoadingCurve of random numbers in full double precision, convex like a curve of growing contact."""
    random = np.random.default_rng(seed)
    depth, stiffness = (np.cumsum(random.random(levels) + 0.1) * scale for scale in (1e-7, 1e-6))
    before = np.append(0.0, stiffness)[:-1]
    mean_stiffness = before + random.random(levels) * (stiffness - before)
    elements = changes.get("elements", 1009)
    values = {
        "depth": depth,
        "force": np.cumsum(mean_stiffness * np.diff(depth, prepend=0)),
        "stiffness": stiffness,
        "contact_count": np.sort(random.integers(1, elements + 1, levels)),
        "elements": elements,
        "method": "boundary elements",
        "tolerance": 1e-3 / 3,
        "operator_applications": 41,
        "residual": random.random(levels) * 1e-4,
        "length_unit": "m",
    }
    return LoadingCurve(**(values | changes))


def assert_same_curve(curve, other):
    """Assert that every field is equal in value and type."""
    for field in dataclasses.fields(LoadingCurve):
        value, other_value = getattr(curve, field.name), getattr(other, field.name)
        np.testing.assert_array_equal(value, other_value, err_msg=field.name, strict=True)
        assert type(value) is type(other_value), field.name


def curve_of_levels(depth, force, stiffness, contact_count, tolerance=1e-9):
    """Make a LoadingCurve of these levels. The tolerance determines the number of springs of its row."""
    levels = (np.asarray(values) for values in (depth, force, stiffness, contact_count))
    return LoadingCurve(*levels, 10**6, "by hand", tolerance, 0, np.zeros(len(depth)))


def curve_of_body(body, depth, tolerance=1e-9):
    """Return the curve of a body of revolution. Ten elements join at each level, so at_force interpolates smoothly."""
    count = 10 * np.arange(1, depth.size + 1)
    return curve_of_levels(depth, body.force(depth), body.stiffness(depth), count, tolerance)
