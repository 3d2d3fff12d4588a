"""Results as values: equal to results with the same numbers, unequal to arrays, and read-only after any copy."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest

import viscorough
from support.contract import refused
from viscorough.basics.arrays import ReadOnlyArrays
from viscorough.io.datasets import read_dataset
from viscorough.io.saving import Result
from viscorough.viscous.integration.events import newtonian_events

DISC = viscorough.self_affine_disc(0.7, 9, rms=1e-8, diameter=1e-6, length_unit="m", seed=1)
CURVE = viscorough.indent(DISC, until_fraction=1.0)
SOLID = viscorough.StandardLinearSolid(4e6, 1e6, 0.5)
FORCE = 2e-8
TIMES = np.arange(1.0, 7.0)


def results():
    """Make a new result of every kind."""
    yield DISC.to("um")
    yield viscorough.indent(DISC, until_fraction=0.5)
    yield viscorough.contact_at(DISC, depth=1e-9)
    yield viscorough.contact_at(DISC, depth=1e-9).patches()
    yield viscorough.kinetics(CURVE, FORCE, SOLID, TIMES)
    yield viscorough.kinetics(CURVE, FORCE, SOLID)
    yield viscorough.Load([0.0, 1.0], force=[1.0, 2.0])
    yield viscorough.Load([0.0, 1.0], depth=[1e-9, 1e-9])
    yield viscorough.kinetics(CURVE, depth=[1e-9, 1e-9], medium=SOLID, times=[0.0, 1.0])
    yield newtonian_events(DISC)
    for force in ([FORCE, FORCE], [FORCE, 0.1 * FORCE]):
        yield viscorough.march(DISC, viscorough.Load([0.0, 1.0], force=force), SOLID)
    held = viscorough.Load([0.0, 1.0], force=[FORCE, FORCE])
    yield viscorough.march(DISC, held, 1.0, method="events")
    yield viscorough.estimate(0.7, 0.1, 1.0, 1.0, 1.0, [0.01, 0.1])


PAIRS = [pytest.param(*pair, id=type(pair[0]).__name__) for pair in zip(results(), results(), strict=True)]


def arrays_in(result):
    """Yield all arrays of a result, also of results within it."""
    values = result if isinstance(result, tuple) else [getattr(result, f.name) for f in dataclasses.fields(result)]
    for value in values:
        if isinstance(value, np.ndarray):
            yield value
        elif isinstance(value, ReadOnlyArrays):
            yield from arrays_in(value)


@pytest.mark.parametrize(("one", "same"), PAIRS)
def test_results_with_equal_numbers_are_equal(one, same):
    assert (one == one) is True
    assert (one == same) is True
    assert (one != same) is False
    for other in (np.arange(3.0), np.array(1.0), [1.0], None, "text", CURVE.depth):
        assert (one == other) is False
        assert (other == one) is False
        assert (one != other) is True


def test_results_with_different_numbers_differ():
    load = viscorough.Load([0.0, 1.0], force=[1.0, 1.0])
    assert load != viscorough.Load([0.0, 1.0], force=[1.0, 2.0])
    assert load != viscorough.Load([0.0, 1.0], depth=[1.0, 1.0])
    numbers = [np.array([1.0])] * 5
    assert viscorough.Motion(*numbers) == viscorough.Motion(*numbers)
    assert viscorough.Motion(*numbers, receding_from=1.0) != viscorough.Motion(*numbers)


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda result: pickle.loads(pickle.dumps(result))])
@pytest.mark.parametrize(("one", "same"), PAIRS)
def test_results_and_their_copies_are_equal_and_read_only(one, same, copied):
    made = copied(one)
    assert made == one == same
    for array in (*arrays_in(one), *arrays_in(made)):
        assert not array.flags.writeable


CURVE_OF_TWO = {
    "depth": [1.0, 2.0],
    "force": [1.0, 4.0],
    "stiffness": [2.0, 4.0],
    "contact_count": [1, 2],
    "elements": 4,
    "method": "none",
    "tolerance": 0.1,
    "operator_applications": 0,
    "residual": [0.0, 0.0],
}


def test_a_contact_has_three_maps_of_one_shape():
    contact = viscorough.contact_at(DISC, depth=1e-9)
    for changed in ({"contact": None}, {"gap": None}, {"pressure": [[1.0]]}, {"contact": contact.pressure}):
        with refused("Contact: "):
            dataclasses.replace(contact, **changed)


@pytest.mark.parametrize("name", ["depth", "force", "stiffness", "contact_count", "residual"])
@pytest.mark.parametrize("values", [[1.0], [[1.0, 2.0]]], ids=repr)
def test_arrays_of_a_curve_have_one_value_for_each_level(name, values):
    assert viscorough.LoadingCurve(**CURVE_OF_TWO).depth.size == 2
    with refused("loading curve: "):
        viscorough.LoadingCurve(**CURVE_OF_TWO | {name: values})


@pytest.mark.parametrize("changed", [{"elements": 0}, {"tolerance": -0.1}, {"tolerance": np.inf}], ids=repr)
def test_a_curve_has_elements_and_a_tolerance(changed):
    with refused("loading curve|LoadingCurve"):
        viscorough.LoadingCurve(**CURVE_OF_TWO | changed)


def test_a_load_has_an_integral_and_further_samples():
    load = viscorough.Load([0.0, 1.0, 1.0, 3.0], force=[0.0, 2.0, 1.0, 1.0])
    assert load.integral.tolist() == [0.0, 1.0, 1.0, 3.0]
    more, place = load.with_times([0.5, 1.0, 2.0])
    assert more.time.tolist() == [0.0, 0.5, 1.0, 1.0, 2.0, 3.0]
    assert more.values[place].tolist() == [1.0, 1.0, 1.0]
    assert load.in_units_of("um").values[1] == 2.0 / 1e-12
    depth = viscorough.Load([0.0, 1.0], depth=[0.0, -1.0])
    assert (depth.by_depth, load.by_depth) == (True, False)
    assert depth.in_units_of("um") == depth


def test_times_equal_up_to_rounding_share_a_sample():
    load = viscorough.Load([0.0, 0.3, 0.3, 1.0], depth=[0.0, 3.0, 1.0, 1.0])
    for time in (np.nextafter(0.3, 0), 0.3, np.nextafter(0.3, 1)):
        more, place = load.with_times([0.1, np.nextafter(0.1, 1), time, np.nextafter(1, 2)])
        assert more.time.tolist() == [0.0, 0.1, 0.3, 0.3, 1.0]
        assert place.tolist() == [1, 1, 3, 4]


@pytest.mark.parametrize("force", [[-1.0, 1.0], [np.inf, 1.0], [1j, 1.0], [1.0], 1.0], ids=repr)
def test_a_force_that_pulls_or_is_not_finite_is_no_load(force):
    with refused("Load: force"):
        viscorough.Load([0.0, 1.0], force=force)


def test_a_load_is_a_force_or_a_depth():
    for values in ({}, {"force": [1.0, 1.0], "depth": [1.0, 1.0]}):
        with refused("Load: one of force and depth is needed"):
            viscorough.Load([0.0, 1.0], **values)
    with refused("Load: depth: sample 1 is nan; allowed: finite"):
        viscorough.Load([0.0, 1.0], depth=[0.0, np.nan])


SAVED = [pytest.param(one, id=type(one).__name__) for one in results() if isinstance(one, Result)]


def test_texts_of_results_are_short():
    """Texts in notebooks contain no arrays of numbers, either."""
    heights = viscorough.self_affine_disc(0.7, 65, rms=1.0, seed=1)
    curve = viscorough.indent(heights, until_fraction=0.2)
    contact = viscorough.contact_at(heights, depth=0.1)
    times = np.geomspace(1, 10, 200)
    short = [heights, curve, contact, contact.patches(), viscorough.penetration_law(0.7), viscorough.SolverOptions()]
    short += [viscorough.Load(times, force=times), viscorough.Load(times, depth=times)]
    short += [viscorough.kinetics(curve, depth=0.5 * curve.depth[-1] * times / times[-1], medium=SOLID, times=times)]
    short += [viscorough.estimate(0.7, 0.1, 1.0, 1.0, 1.0, 0.01 * times)]
    for result in short:
        assert len(repr(result)) < 400, repr(result)
        assert "array(" not in repr(result)


def test_text_of_options_shows_values_other_than_the_default():
    assert repr(viscorough.SolverOptions()) == "SolverOptions()"
    changed = viscorough.SolverOptions(precision="double", padding=False)
    assert eval(repr(changed), {"SolverOptions": viscorough.SolverOptions}) == changed
    assert repr(changed) == "SolverOptions(precision='double', padding=False)"


@pytest.mark.parametrize("result", SAVED)
def test_results_are_saved_drawn_and_converted(result, tmp_path):
    """The dataset has the variables, attributes and coordinates of the NetCDF file."""
    path = tmp_path / "result.nc"
    viscorough.save(result, path)
    viscorough.plot(result, tmp_path / "figure.png")
    assert (tmp_path / "figure.png").stat().st_size > 1000
    dataset = viscorough.to_dataset(result)
    written = read_dataset(path)
    assert set(dataset.coords) == set(written.coords)
    for name in dataset.attrs.keys() - {"history"}:
        np.testing.assert_array_equal(dataset.attrs[name], written.attrs[name])
    assert dataset.equals(written)
