"""Round trips from a medium to a depth or a force over time and back, and records that are refused."""

import identification
import numpy as np
import pytest

from support.contract import refused
from support.curves import curve_of_body
from support.media import MEDIA
from viscorough import (
    AccuracyWarning,
    Load,
    Motion,
    Prony,
    Springpot,
    identify_medium,
    indent,
    kinetics,
    self_affine_disc,
)
from viscorough.reference import sphere

CURVE = curve_of_body(sphere(1.0), np.geomspace(1e-9, 10, 300))
TIMES = np.geomspace(0.02, 60, 50)


def record(medium, *, ramp=False):
    """The force that brings the creep to 10 in the end, and the depth under it."""
    force = 10 / float(medium.creep_compliance(TIMES[-1]))
    force = Load([0.0, 2.0, TIMES[-1]], force=[0.0, force, force]) if ramp else force
    return force, kinetics(CURVE, force, medium, TIMES).depth


@pytest.mark.parametrize("ramp", [False, True])
@pytest.mark.parametrize("name", MEDIA)
def test_exact_records_give_the_compliance(name, ramp):
    """Within 0.1 %, or within the 1 % by which the chords of a table differ from every relaxing medium."""
    force, depth = record(MEDIA[name], ramp=ramp)
    identified = identify_medium(CURVE, force, TIMES, depth)
    wanted = MEDIA[name].creep_compliance(TIMES)
    rtol = 0.006 if name == "table" else 1e-3
    np.testing.assert_allclose(identified.medium.creep_compliance(TIMES), wanted, rtol=rtol)


@pytest.mark.parametrize("name", ["newtonian", "maxwell", "kelvin-voigt", "solid"])
def test_exact_records_of_few_elements_give_their_amounts_and_times(name):
    """The retardation times are unknowns of the fit, and not the nearest times of a grid."""
    force, depth = record(MEDIA[name], ramp=True)
    found, exact = identify_medium(CURVE, force, TIMES, depth).medium, MEDIA[name].retardation
    largest = float(MEDIA[name].creep_compliance(TIMES[-1]))
    kept = found.compliances > 1e-6 * largest
    np.testing.assert_allclose(found.retardation_times[kept], exact.times, rtol=1e-4)
    np.testing.assert_allclose(found.compliances[kept], exact.compliances, rtol=1e-4)
    assert found.instantaneous_compliance == pytest.approx(exact.instantaneous_compliance, abs=1e-6 * largest)
    assert found.fluidity == pytest.approx(exact.fluidity, abs=1e-6 * largest / TIMES[-1])


@pytest.mark.parametrize(("rows", "noise", "unknown"), [(8, 1e-3, 0.5), (20, 1e-4, 0.05), (60, 1e-2, 0.0)])
@pytest.mark.parametrize("name", ["newtonian", "solid", "kelvin-voigt"])
def test_intervals_hold_the_compliance(name, rows, noise, unknown):
    """Few-row version of benchmarks/identification.py: coverage, share of unknown intervals, width and scatter."""
    cell = identification.coverage((name, "step", rows, noise), trials=20)
    assert cell["coverage"] >= 0.92
    assert cell["unknown"] <= unknown
    assert cell["width"] < (12 if rows == 8 else 6)
    assert cell["scatter"] == pytest.approx(1, abs=0.5 if rows == 8 else 0.2)


def test_intervals_under_a_ramp_hold_the_compliance():
    """The chords of J between its knots do not shift the intervals of a precise record."""
    cell = identification.coverage(("solid", "ramp", 60, 1e-5), trials=8)
    assert cell["coverage"] >= 0.92
    assert cell["unknown"] == 0


def test_intervals_of_a_scatter_that_is_estimated_are_wider():
    """A few rows determine the scatter badly, as Student's t shows; a stated scatter is certain."""
    times = TIMES[::5]
    force, _ = record(MEDIA["kelvin-voigt"])
    depth = kinetics(CURVE, force, MEDIA["kelvin-voigt"], times).depth
    depth = depth + 1e-4 * depth[-1] * np.random.default_rng(1).standard_normal(depth.size)
    found = identify_medium(CURVE, force, times, depth)
    stated = identify_medium(CURVE, force, times, depth, scatter=found.scatter)
    assert stated.scatter == found.scatter
    shown = found.time >= times[0]
    assert ((found.high - found.low) > 1.1 * (stated.high - stated.low))[shown].all()
    half = identify_medium(CURVE, force, times, depth, scatter=0.5 * found.scatter)
    assert (half.low >= stated.low)[shown].all()
    assert (half.high <= stated.high)[shown].all()


@pytest.mark.parametrize(("rows", "noise"), [(8, 0.0), (5, 1e-3)])
def test_intervals_that_the_record_does_not_determine_are_unknown(rows, noise):
    """The fit meets an exact record to rounding, and five rows of a springpot with as many unknowns."""
    times, medium = np.geomspace(0.02, 60, rows), MEDIA["springpot" if noise else "solid"]
    force = 10 / float(medium.creep_compliance(60.0))
    depth = kinetics(CURVE, force, medium, times).depth
    noise = noise * depth[-1]
    depth = depth + noise * np.random.default_rng(1).standard_normal(rows)
    found = identify_medium(CURVE, force, times, depth)
    assert np.isnan([found.scatter, *found.low, *found.high]).all()
    assert "scatter of depth unknown" in str(found)
    deviation = noise or 1e-3 * depth[-1]
    stated = identify_medium(CURVE, force, times, depth, scatter=deviation)
    exact = medium.creep_compliance(stated.time)
    assert ((stated.low < exact) & (exact < stated.high))[stated.time >= times[0]].all()
    assert f"scatter of depth {deviation:.3g}" in str(stated)


@pytest.mark.parametrize(("name", "rows"), [("solid", 50), ("prony", 8)])
def test_a_medium_that_misses_the_record_warns(name, rows):
    """A springpot, fitted to springs and dashpots: the scatter is known in 50 rows, unknown in 8 rows."""
    times = np.geomspace(0.02, 60, rows)
    force, _ = record(MEDIA[name])
    depth = kinetics(CURVE, force, MEDIA[name], times).depth
    depth = depth + 1e-3 * depth[-1] * np.random.default_rng(2).standard_normal(rows)
    with pytest.warns(AccuracyWarning, match=r"the medium misses the record by .* \(rms\), .* of the largest depth"):
        found = identify_medium(CURVE, force, times, depth, kind="springpot")
    assert np.isnan(found.scatter) == (rows == 8)
    fitted = CURVE.at_force(force * found.medium.creep_compliance(times))[0]
    assert found.misfit == pytest.approx(np.sqrt(np.mean((fitted - depth) ** 2)), rel=1e-6)
    assert found.misfit > 0.02 * depth[-1]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("name", "kind"), [("springpot", "springpot"), ("solid", "prony"), ("maxwell", "prony")])
def test_a_medium_that_meets_the_record_does_not_warn(name, kind):
    force, depth = record(MEDIA[name])
    noise = 1e-3 * depth[-1]
    for seed in range(5):
        noisy = depth + noise * np.random.default_rng(seed).standard_normal(depth.size)
        found = identify_medium(CURVE, force, TIMES, noisy, kind=kind)
        assert 0.5 * noise < found.misfit < 1.5 * noise


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("ramp", [False, True])
@pytest.mark.parametrize(
    ("name", "kind"), [("solid", Prony), ("prony", Prony), ("maxwell", Prony), ("springpot", Springpot)]
)
def test_media_are_fitted(name, kind, ramp):
    force, depth = record(MEDIA[name], ramp=ramp)
    identified = identify_medium(CURVE, force, TIMES, depth, kind=kind.__name__.lower()).medium
    assert isinstance(identified, kind)
    rtol = 1e-5 if kind is Springpot and not ramp else 3e-3
    np.testing.assert_allclose(identified.creep_compliance(TIMES), MEDIA[name].creep_compliance(TIMES), rtol=rtol)


def test_records_that_no_growing_contact_can_have_are_refused():
    force, depth = record(MEDIA["solid"])
    with refused("record: at time .* the depth has receded by .*; allowed: depths that grow, unless"):
        identify_medium(CURVE, force, TIMES, np.append(depth[:-5], 0.9 * depth[-5:]))
    with refused("record: depth 11 at time .* beyond the curve's last level; allowed: up to 10; indent further"):
        identify_medium(CURVE, force, TIMES, np.append(depth[:-1], 11.0))
    with refused("record: 4 times, .*; allowed: five or more rows"):
        identify_medium(CURVE, force, TIMES[:4], depth[:4])
    with refused("times: start at -1; allowed: from 0 on, where a constant force begins"):
        identify_medium(CURVE, force, TIMES - 1.02, depth)
    with refused("kind 'maxwell'; allowed: table, prony, springpot"):
        identify_medium(CURVE, force, TIMES, depth, kind="maxwell")
    force, depth = record(MEDIA["newtonian"])
    with refused("kind 'prony': the record shows no compliance at once"):
        identify_medium(CURVE, force, TIMES, depth, kind="prony")
    for choice in (2, -1, None, "yes"):
        with refused("fit_offset: .*; allowed: True or False"):
            identify_medium(CURVE, force, TIMES, depth, fit_offset=choice)
    for scatter in (0.0, -1.0, np.nan, np.inf):
        with refused("scatter: .* finite"):
            identify_medium(CURVE, force, TIMES, depth, scatter=scatter)


@pytest.mark.parametrize("kind", ["table", "springpot"])
@pytest.mark.filterwarnings("ignore::viscorough.basics.errors.AccuracyWarning")
def test_force_may_step_down_in_a_record(kind):
    """The depth in a fluid goes on growing, although that in the fitted medium recedes a little at the step."""
    times, force = np.array([0.0, 5.0, 5.0, 60.0]), np.array([1.0, 1.0, 0.6, 0.6])
    load = Load(times, force=0.5 * force)
    depth = kinetics(CURVE, load, MEDIA["newtonian"], TIMES).depth
    noisy = depth + 1e-3 * depth[-1] * np.random.default_rng(0).standard_normal(TIMES.size)
    found = identify_medium(CURVE, load, TIMES, noisy, kind=kind)
    assert np.isfinite(found.misfit)
    assert found.compliance[-1] == pytest.approx(20, rel=0.02)


@pytest.mark.filterwarnings("ignore::viscorough.basics.errors.AccuracyWarning")
@pytest.mark.parametrize(("rows", "seed"), [(6, 152), (8, 98), (20, 15), (100, 4), (200, 11)])
def test_noise_of_level_records_is_not_taken_for_receding_depths(rows, seed):
    """Few rows show their own standard deviation badly, and the last depths of this record are equal but for noise."""
    times = np.geomspace(10, 60, rows)
    force, _ = record(MEDIA["kelvin-voigt"])
    depth = kinetics(CURVE, force, MEDIA["kelvin-voigt"], times).depth
    noisy = depth + 1e-2 * depth[-1] * np.random.default_rng([rows, seed]).standard_normal(rows)
    assert identify_medium(CURVE, force, times, noisy).compliance.size


def test_slowly_receding_depths_are_refused():
    """Means over rows scatter less than single rows: a drop of three standard deviations in the mean is no noise."""
    times = np.geomspace(0.02, 60, 64)
    force, _ = record(MEDIA["solid"])
    depth = kinetics(CURVE, force, MEDIA["solid"], times).depth
    noise = 1e-2 * depth[-1]
    depth = depth + noise * np.random.default_rng(3).standard_normal(64)
    identify_medium(CURVE, force, times, depth)
    depth[48:] -= 3 * noise
    with refused("the depth has receded"):
        identify_medium(CURVE, force, times, depth)


FEWER_LEVELS = curve_of_body(sphere(1.0), np.geomspace(1e-6, 10, 300))
# A row of 4000 springs instead of 75000. A fit of a springpot moves this row a dozen times, each spring with 110
# branches. The record comes from the same row, so its error has no effect.
FEWER_SPRINGS = curve_of_body(sphere(1.0), np.geomspace(1e-6, 10, 300), tolerance=1e-4)
DEPTHS = {
    "relaxation": Load([0.0, 60.0], depth=[3.0, 3.0]),
    "ramp and hold": Load([0.0, 2.0, 60.0], depth=[0.0, 3.0, 3.0]),
    "force curve": Load([0.0, 2.0, 30.0, 60.0], depth=[0.0, 3.0, 3.0, -1.0]),
    "reload": Load([0.0, 2.0, 20.0, 30.0, 40.0, 60.0], depth=[0.0, 3.0, 3.0, 2.0, 2.5, 2.5]),
}
# In a Newtonian or a Kelvin-Voigt medium a step of the depth takes an infinite force.
FORCES = [
    (history, name)
    for history in DEPTHS
    for name in MEDIA
    if history == "ramp and hold"
    or (name in ("maxwell", "solid", "prony") or (name == "springpot") == (history == "force curve"))
    if not (history == "relaxation" and name in ("newtonian", "kelvin-voigt", "table"))
]


@pytest.mark.long
@pytest.mark.filterwarnings("ignore::viscorough.basics.errors.AccuracyWarning")
@pytest.mark.parametrize(("history", "name"), FORCES)
def test_exact_forces_give_the_compliance(history, name):
    """Within 1 % from the first row to the last one; a table of chords is no medium of springs and dashpots."""
    force = kinetics(FEWER_LEVELS, depth=DEPTHS[history], medium=MEDIA[name], times=TIMES).force
    identified = identify_medium(FEWER_LEVELS, DEPTHS[history], TIMES, force, kind="prony")
    exact = MEDIA[name].creep_compliance(TIMES)
    np.testing.assert_allclose(identified.medium.creep_compliance(TIMES), exact, rtol=0.02 if name == "table" else 0.01)
    assert identified.misfit < (1e-3 if name == "table" else 2e-4) * force.max()


@pytest.mark.long
@pytest.mark.parametrize("name", ["kelvin-voigt", "solid", "prony"])
def test_exact_depths_of_a_receding_contact_give_the_compliance(name):
    force = 10 / float(MEDIA[name].creep_compliance(TIMES[-1]))
    load = Load([0.0, 2.0, 30.0, 60.0], force=[0.0, force, force, 0.05 * force])
    motion = kinetics(FEWER_LEVELS, load, MEDIA[name], TIMES)
    assert motion.depth[-1] < 0.99 * motion.depth.max(), "it recedes"
    identified = identify_medium(FEWER_LEVELS, load, TIMES, motion.depth)
    exact = MEDIA[name].creep_compliance(TIMES)
    np.testing.assert_allclose(identified.medium.creep_compliance(TIMES), exact, rtol=0.006)


@pytest.mark.parametrize("noise", [0.0, 0.3])
@pytest.mark.parametrize("name", ["newtonian", "maxwell", "solid"])
def test_receding_records_without_visible_delayed_creep_are_fitted(name, noise):
    """A fluid has no Kelvin-Voigt elements, and large noise hides those of a solid."""
    times = np.geomspace(0.02, 60, 20)
    force = 10 / float(MEDIA[name].creep_compliance(60.0))
    load = Load([0.0, 2.0, 30.0, 60.0], force=[0.0, force, force, 0.0])
    depth = kinetics(FEWER_SPRINGS, load, MEDIA[name], times).depth
    depth = depth + noise * depth.max() * np.random.default_rng(1).standard_normal(20)
    identified = identify_medium(FEWER_SPRINGS, load, times, depth)
    exact = MEDIA[name].creep_compliance(times[-1])
    assert identified.compliance[-1] == pytest.approx(exact, rel=0.5 if noise else 0.01)


@pytest.mark.long
@pytest.mark.parametrize("history", ["ramp and hold", "force curve"])
def test_springpots_are_fitted_to_forces(history):
    force = kinetics(FEWER_SPRINGS, depth=DEPTHS[history], medium=MEDIA["springpot"], times=TIMES).force
    medium = identify_medium(FEWER_SPRINGS, DEPTHS[history], TIMES, force, kind="springpot").medium
    assert (medium.modulus, medium.exponent) == pytest.approx((2.0, 0.4), rel=1e-4)


@pytest.mark.long
def test_springpots_are_fitted_to_receding_depths():
    load = Load([0.0, 2.0, 30.0, 60.0], force=[0.0, 2.0, 2.0, 0.1])
    depth = kinetics(FEWER_SPRINGS, load, MEDIA["springpot"], TIMES).depth
    medium = identify_medium(FEWER_SPRINGS, load, TIMES, depth, kind="springpot").medium
    assert (medium.modulus, medium.exponent) == pytest.approx((2.0, 0.4), rel=1e-4)


@pytest.mark.long
@pytest.mark.parametrize(
    ("load", "name"), [("hold", "solid"), ("hold", "newtonian"), ("retract", "prony"), ("unload", "solid")]
)
def test_intervals_of_other_records_hold(load, name):
    """Few-row version of benchmarks/identification.py: coverage of the modulus, or of the compliance."""
    cell = identification.coverage((name, load, 50, 1e-3), trials=5)
    assert cell["coverage"] >= 0.85
    assert cell["unknown"] == 0
    assert cell["scatter"] == pytest.approx(1, abs=0.3)


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "load"), [("solid", "step"), ("solid", "hold"), ("newtonian", "hold"), ("kelvin-voigt", "hold")]
)
def test_a_wrong_zero_and_a_drift_of_the_depth_are_found(name, load):
    """An error of the zero of 2 % of the largest depth and a drift by 1 % of it; without the options J is wrong.

    In media with a parallel dashpot the misfit rises steeply at one end of the interval of the offset.
    """
    cell = identification.coverage((name, load, 50, 1e-3), trials=4, wrong_zero=True)
    assert cell["offset_coverage"] >= 0.75
    assert cell["drift_coverage"] >= 0.75
    assert cell["coverage"] >= 0.9


def test_a_wrong_zero_changes_the_compliance_as_stated():
    """The depth of a blunt indenter grows with J to the power 2/3: 0.1 % of the last depth are 0.15 % of the last J."""
    force, depth = record(MEDIA["maxwell"])
    identified = identify_medium(CURVE, force, TIMES, depth)
    assert identified.assumed_offset == pytest.approx(1e-3 * depth.max())
    shifted = identify_medium(CURVE, force, TIMES, depth - identified.assumed_offset)
    shown = identified.time >= TIMES[0]
    change = np.abs(shifted.compliance[shown] / identified.compliance[shown] - 1)
    assert identified.offset_effect == pytest.approx(change.max())
    assert change[-1] == pytest.approx(1.5e-3, rel=0.3)
    assert f"would change J by up to {100 * change.max():.2g} %" in str(identified)


def test_a_scatter_above_the_depth_leaves_the_zero_unknown():
    """A zero that is wrong by more than the depth leaves no depth to fit."""
    force, depth = record(MEDIA["solid"])
    assert identify_medium(CURVE, force, TIMES, depth, scatter=10 * depth.max()).offset_effect == np.inf


def test_retardation_time_between_times_of_the_grid_is_no_error_of_the_zero():
    """On the grid alone, the misfit of the true zero is ten times the noise, and a wrong zero fits better."""
    cell = identification.coverage(("kelvin-voigt", "step", 50, 1e-4), trials=2, wrong_zero=True)
    assert cell["offset_coverage"] == 1
    assert cell["coverage"] > 0.8


def test_drift_that_slow_creep_replaces_lies_in_its_interval():
    """The best fit has a large drift and a dashpot that compensates it, and its tangent misses the true drift."""
    cell = identification.coverage(("kelvin-voigt", "unload", 50, 1e-2), trials=4, wrong_zero=True)
    assert cell["drift_coverage"] == 1


def test_forces_are_in_newtons_and_moduli_in_pascals():
    """The same numbers on a micrometre scale and on a scale of unit lengths."""
    disc = self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, seed=1, length_unit="m")
    curve, medium = indent(disc), Prony(1e6, [2e6], [5.0])
    load, times = Load([0.0, 1.0, 100.0], depth=[0.0, 1e-6, 1e-6]), np.geomspace(0.1, 100, 40)
    motion: Motion = kinetics(curve, depth=load, medium=medium, times=times)
    noise = 1e-3 * motion.force.max()
    force = motion.force + noise * np.random.default_rng(1).standard_normal(40)
    identified = identify_medium(curve, load, times, force)
    assert identified.relaxation_modulus[-1] == pytest.approx(1e6, rel=0.01)
    assert identified.scatter == pytest.approx(noise, rel=0.5)
    assert identify_medium(curve, load, times, force, scatter=f"{noise} N").scatter == pytest.approx(noise)


def test_records_of_other_histories_that_show_nothing_are_refused():
    load = DEPTHS["ramp and hold"]
    with refused("record: no force"):
        identify_medium(FEWER_LEVELS, load, TIMES, np.zeros(TIMES.size))
    with refused("record: no force"):
        identify_medium(FEWER_LEVELS, Load([0.0, 60.0], depth=[0.0, 0.0]), TIMES, np.ones(TIMES.size), fit_drift=True)
    with refused("record: no depth before the force decreases"):
        unload = Load([0.0, 2.0, 30.0, 60.0], force=[0.0, 1.0, 1.0, 0.1])
        identify_medium(FEWER_LEVELS, unload, TIMES, np.where(TIMES < 30, 0.0, 6 - 0.1 * TIMES))
    with refused("record: a largest value of 1e-215, whose square leaves double precision"):
        identify_medium(FEWER_LEVELS, load, TIMES, np.full(TIMES.size, 1e-215), fit_drift=True)
    with refused("record: depth 11 .* beyond the curve's last level"):
        identify_medium(FEWER_LEVELS, Load([0.0, 60.0], depth=[0.0, 11.0]), TIMES, np.ones(TIMES.size))
    with refused("the zero of the depth is off by .* or more; allowed: errors below"):
        moved = Load([0.0, 2.0, 60.0], depth=[1.5, 4.5, 4.5])
        force = kinetics(FEWER_LEVELS, depth=load, medium=MEDIA["solid"], times=TIMES).force
        identify_medium(FEWER_LEVELS, moved, TIMES, force, fit_offset=True)
    falling = Load([0.0, 0.03, 60.0], force=[2.0, 2.0, 0.0])
    depth = kinetics(FEWER_LEVELS, falling, MEDIA["solid"], TIMES).depth
    with refused("record: 3 rows before the force decreases at time 0.03; allowed: five or more"):
        identify_medium(FEWER_LEVELS, falling, TIMES, depth)
