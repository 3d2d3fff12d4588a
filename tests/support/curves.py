"""Loading curves of random numbers, for tests that write and read them."""

import dataclasses

import numpy as np

from viscorough.loading_curve import LoadingCurve


def random_curve(levels=7, seed=0, **changes):
    """A LoadingCurve of increasing random numbers in full double precision, which describe no real contact."""
    random = np.random.default_rng(seed)
    values = {
        "depth": np.cumsum(random.random(levels) + 0.1) * 1e-7,
        "force": np.cumsum(random.random(levels) + 0.1) * 1e-13,
        "stiffness": np.cumsum(random.random(levels) + 0.1) * 1e-6,
        "contact_count": np.cumsum(random.integers(1, 9, levels)),
        "elements": 1009,
        "method": "boundary elements",
        "tolerance": 1e-3 / 3,
        "operator_applications": 41,
        "residual": random.random(levels) * 1e-4,
        "length_unit": "m",
    }
    return LoadingCurve(**(values | changes))


def assert_same_curve(one, other):
    """Assert that every field is equal in value and type."""
    for field in dataclasses.fields(LoadingCurve):
        value, other_value = getattr(one, field.name), getattr(other, field.name)
        np.testing.assert_array_equal(value, other_value, err_msg=field.name, strict=True)
        assert type(value) is type(other_value), field.name


def one_line(error):
    """The message of a pytest.raises, which must be a single line."""
    text = str(error.value)
    assert text
    assert "\n" not in text
    return text
