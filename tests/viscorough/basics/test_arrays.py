"""Arrays that objects keep: they cannot be changed from outside, and masks are not lost."""

import numpy as np
import pytest

from support.curves import random_curve
from viscorough import Indenter, Load, contact_at, kinetics
from viscorough.basics.arrays import read_only
from viscorough.viscous.integration.events import march_events
from viscorough.viscous.integration.stepping import march_steps

HILL = Indenter([[0.0, 1.0], [0.5, 0.2]], 1.0)


@pytest.mark.parametrize("values", [np.arange(6.0)[::2], (1, 2), np.broadcast_to(1.0, 3)], ids=repr)
def test_arrays_are_copied(values):
    kept = read_only(values)
    np.testing.assert_array_equal(kept, values)
    assert not kept.flags.writeable
    assert not np.shares_memory(kept, values)


def test_only_immutable_arrays_are_not_copied():
    array = np.arange(3.0)
    view = array[1:]
    view.flags.writeable = False
    assert not np.shares_memory(read_only(view), array), "the view is read-only, what it shows is not"
    array.flags.writeable = False
    assert np.shares_memory(read_only(array), array)
    assert np.shares_memory(read_only(array[1:]), array)


@pytest.mark.parametrize("dtype", [float, np.float32, int])
def test_masked_entries_are_nan(dtype):
    masked = np.ma.array([[1, 2], [3, 4]], mask=[[0, 1], [0, 0]], dtype=dtype)
    for values in (masked, list(masked)):
        np.testing.assert_array_equal(read_only(values), [[1, np.nan], [3, 4]])
    np.testing.assert_array_equal(read_only(masked[1]), [3, 4])
    assert read_only(masked[1]).dtype == dtype, "where nothing is masked the type stays"


def arrays_of(result):
    fields = result._asdict() if hasattr(result, "_asdict") else vars(result)
    return {name: value for name, value in fields.items() if isinstance(value, np.ndarray)}


@pytest.mark.parametrize(
    "result",
    [
        random_curve(),
        HILL,
        kinetics(random_curve(), 1.0, 1.0),
        Load([1.0, 2.0], force=[1.0, 1.0]),
        march_events(HILL),
        march_steps(HILL, np.array([0.1, 1.0])),
        contact_at(HILL, depth=0.1),
    ],
    ids=lambda result: type(result).__name__,
)
def test_arrays_of_inputs_and_results_are_read_only(result):
    assert arrays_of(result)
    for name, array in arrays_of(result).items():
        with pytest.raises(ValueError, match="read-only"):
            array *= 2
        assert not array.flags.writeable, name


def test_masked_samples_of_a_force_are_refused():
    masked = np.ma.array([1.0, 2.0, 3.0], mask=[0, 1, 0])
    with pytest.raises(ValueError, match="sample 1 is nan"):
        Load([0, 1, 2], force=masked)
    with pytest.raises(ValueError, match="time: allowed is one row of finite numbers"):
        Load(masked, force=[1, 2, 3])
    with pytest.raises(ValueError, match="finite numbers"):
        march_steps(HILL, masked)
