"""Kinetics of contacts that recede and return, against closed forms of Ting and direct integration.

    GRID=257 python -m pytest -s tests/viscorough/viscous/test_any_history.py -k grids

compares bodies on maps of up to that many elements across with exact solutions, and prints errors and orders.
"""

import functools
import os
from functools import partial

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import gamma

from support.contract import refused
from support.curves import curve_of_body
from support.media import MEDIA, SPRINGS_AND_DASHPOTS
from viscorough import (
    AccuracyWarning,
    Indenter,
    Load,
    Prony,
    Springpot,
    StandardLinearSolid,
    indent,
    kinetics,
    march,
    reference,
    self_affine_disc,
)
from viscorough.viscous.kinetics import row_motion
from viscorough.viscous.row import row_of_springs

BODIES = {"sphere": reference.sphere(1.7), "cone": reference.cone(0.3)}
SPEED, TURN = 0.1, 1.0
GRID = int(os.environ.get("GRID", "65"))


def relaxation_integral(medium, start, end):
    """Return the integral ∫ψ dt from `start` to `end`, in closed form."""
    if isinstance(medium, Springpot):
        power = 1 - medium.exponent
        return medium.modulus * (end**power - start**power) / gamma(1 + power)
    _, relaxed, moduli, times = medium.relaxation
    return relaxed * (end - start) + (moduli * times * (np.exp(-start / times) - np.exp(-end / times))).sum()


def ting(body, medium, time):
    """Return the force at a time of an approach and a retract with the same speed.

    F = ∫ψ(t − s) dF_el(u(s)) up to the time t₁ of the present contact size, where ∫ψ(t − s) du(s) = 0 from t₁ to t.
    """
    if time > TURN:
        rest = relaxation_integral(medium, 0.0, time - TURN)

        def balance(first):
            return relaxation_integral(medium, time - TURN, time - first) - rest

        if balance(0.0) <= 0:
            return 0.0
        end = brentq(balance, 0.0, TURN, xtol=1e-15)
    else:
        end = time

    def integrand(s):
        return float(medium.relaxation_modulus(time - s)) * SPEED * body.stiffness(SPEED * s)

    singular = np.isinf(float(medium.relaxation_modulus(0.0))) and end == time
    if singular:
        exponent = medium.exponent
        return quad(
            lambda s: integrand(s) * (time - s) ** exponent if s < time else integrand(time * (1 - 1e-14)) * 0,
            0, time, weight="alg", wvar=(0, -exponent), epsrel=1e-9,
        )[0]  # fmt: skip
    return quad(integrand, 0, end, epsrel=1e-11, epsabs=0, limit=200)[0]


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("name", ["maxwell", "solid", "prony", "springpot"])
def test_approach_and_retract_follow_ting(name, body):
    medium, body = MEDIA[name], BODIES[body]
    curve = curve_of_body(body, np.geomspace(1e-5, 0.2, 301))
    load = Load([0.0, TURN, 2 * TURN], depth=[0.0, SPEED * TURN, 0.0])
    times = np.array([0.3, 0.7, 0.999, 1.05, 1.1, 1.2, 1.3, 1.5, 1.9])
    motion = kinetics(curve, load, medium, times)
    expected = np.array([ting(body, medium, time) for time in times])
    np.testing.assert_allclose(motion.force, expected, rtol=0, atol=3e-5 * expected.max())
    assert motion.receding_from == pytest.approx(TURN, abs=3e-3)


@functools.cache
def curve_of_map(name, across):
    """Return the loading curve of a body on a square map of side 1; the contact stays far from its edge."""
    position = np.linspace(-0.5, 0.5, across)
    radius = np.hypot(position[:, None], position)
    heights = -(radius**2) / (2 * 1.7) if name == "sphere" else -0.3 * radius
    depths = SPEED * np.geomspace(1e-3, 1.0, 100)
    return indent(Indenter(heights, position[1] - position[0]), depths=depths, tolerance=1e-5)


def assert_converges(what, errors):
    """Print errors by the number of elements across; require that they fall, to 1e-3 on the finest grid."""
    grids, values = np.array(list(errors)), np.array(list(errors.values()))
    order = -np.polyfit(np.log(grids), np.log(values), 1)[0]
    print(f"{what}: errors {values.round(6).tolist()} on {grids.tolist()}, order {order:.2g}")
    assert values[-1] < 1e-3
    assert order > 0.8


GRIDS = [n for n in (33, 65, 129, 257) if n <= GRID]


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("name", ["maxwell", "solid", "springpot"])
def test_force_converges_to_ting_on_fine_grids(name, body):
    load = Load([0.0, TURN, 2 * TURN], depth=[0.0, SPEED * TURN, 0.0])
    times = np.array([0.5, 0.8, 0.999, 1.05, 1.1, 1.2, 1.3, 1.5])
    expected = np.array([ting(BODIES[body], MEDIA[name], time) for time in times])
    errors = {}
    for across in GRIDS:
        found = kinetics(curve_of_map(body, across), load, MEDIA[name], times).force
        errors[across] = np.abs(found - expected).max() / expected.max()
    assert_converges(f"{name}, {body}", errors)


def test_release_converges_on_fine_grids():
    """The reference is the depth of a sphere after its force is removed, from a curve without a grid."""
    medium, end = MEDIA["solid"], 0.7
    exact = curve_of_body(BODIES["sphere"], np.geomspace(1e-5, 1, 401))
    force = 0.9 * exact.force[np.searchsorted(exact.depth, SPEED)]
    load = Load([0.0, end, end, 5.0], force=[force, force, 0, 0])
    times = [0.3, 0.7, 1.0, 2.0, 5.0]
    expected = kinetics(exact, load, medium, times).depth
    errors = {}
    for across in GRIDS:
        found = kinetics(curve_of_map("sphere", across), load, medium, times).depth
        errors[across] = np.abs(found - expected).max() / expected.max()
    assert_converges("release of a sphere", errors)


def creep_integral(medium, time):
    """Return ∫J dt from time 0 on."""
    instantaneous, fluidity, compliances, times = medium.retardation
    x = np.divide.outer(time, times)
    delayed = (compliances * times * (x + np.expm1(-x))).sum(axis=-1)
    return instantaneous * time + 0.5 * fluidity * time**2 + delayed


def test_released_sphere_recovers_by_creep():
    """Without a force the deepest point of the imprint recovers: its creep follows from the pressure history."""
    medium, force, end = MEDIA["solid"], 0.05, 0.7
    curve = curve_of_body(BODIES["sphere"], np.geomspace(1e-5, 1, 401))
    motion = kinetics(curve, Load([0.0, end, end, 5.0], force=[force, force, 0, 0]), medium, [0.3, 0.7, 1.0, 2.0, 5.0])
    times = np.linspace(0, end, 20001)
    depth = curve.at_force(force * medium.creep_compliance(times))[0]
    # Compute φ of the first spring from the mean of ψ over every step of its deflection, then its creep at later times.
    relaxation, lag = medium.relaxation, np.diff(times)[0]
    state, carried = 0.0, [medium.relaxation_modulus(0.0) * depth[0]]
    state = depth[0]
    for k in range(1, times.size):
        x = lag / relaxation.times[0]
        state = state * np.exp(-x) + (depth[k] - depth[k - 1]) * -np.expm1(-x) / x
        carried.append(relaxation.relaxed_modulus * depth[k] + relaxation.moduli[0] * state)
    for time, found in zip(motion.time[2:], motion.depth[2:], strict=True):
        steps = np.diff(carried)
        means = (creep_integral(medium, time - times[:-1]) - creep_integral(medium, time - times[1:])) / lag
        expected = carried[0] * medium.creep_compliance(time) + means @ steps
        expected -= carried[-1] * medium.creep_compliance(time - end)
        assert found == pytest.approx(float(expected), rel=2e-5)
    assert (motion.force[1:] == 0).all()
    assert motion.contact_fraction[2:].tolist() == [0, 0, 0]


def maps():
    """Return small maps of many kinds."""
    random = np.random.default_rng(54)
    rough = self_affine_disc(0.7, 9, rms=0.1, seed=2).heights
    rows, columns = np.indices((7, 8))
    crater = -0.1 * np.abs(np.hypot(rows - 3, columns - 3.5) - 2.2)
    holes = 0.1 * random.standard_normal((7, 7))
    holes[random.random((7, 7)) < 0.2] = np.nan
    towers = np.full((7, 7), -0.4)
    towers[1, 1], towers[5, 4:6] = 0.0, -0.05
    return {
        "self-affine": Indenter(rough, 1.0),
        "quantised": Indenter(np.round(8 * rough) / 8, 1.0),
        "crater": Indenter(crater, 1.0),
        "holes": Indenter(holes, 1.0),
        "checkerboard": Indenter(0.2 * ((rows + columns) % 2) + 0.01 * random.random((7, 8)), 1.0),
        "towers": Indenter(towers, 1.0),
        "rectangles": Indenter(rough, 1.0, 3.0),
    }


def history(control, *, steps, scale):
    """Return a load with hold, unload, reload and release; with a step up and a step down if the medium allows them."""
    shape = np.array([0, 1, 1, 0.3, 0.7, 0.7, 0.1, 0.5, 0]) * scale
    times = np.array([0, 1, 1.5, 2, 2.5, 2.5 if steps else 2.6, 3, 3, 4.0])
    if not steps:
        times[7] = 3.3
    else:
        shape[5], shape[7] = 0.8 * scale, 0.2 * scale
    return Load(times, **{control: shape})


@pytest.mark.parametrize("control", ["force", "depth"])
@pytest.mark.parametrize("kind", maps())
def test_kinetics_of_maps_agrees_with_direct_integration(kind, control):
    """The error of the implicit steps falls with their length."""
    indenter = maps()[kind]
    curve = indent(indenter, tolerance=1e-11, until_fraction=1.0)
    for name in ("solid", "newtonian", "prony"):
        medium = SPRINGS_AND_DASHPOTS[name]
        steps = name != "newtonian"
        scale = 0.5 * curve.depth[-1] if control == "depth" else 0.3 * curve.force[-1]
        load = history(control, steps=steps, scale=scale)
        motion = kinetics(curve, load, medium)
        if name == "newtonian" and load.by_depth:
            continue  # steps of a dashpot give the force before each time
        errors = []
        for parts in (30, 240):
            share = np.arange(1, parts + 1) / parts
            lengths = np.diff(load.time)
            inner = np.concatenate(
                [start + length * share[:-1] for start, length in zip(load.time, lengths, strict=False)]
            )
            fine, _ = load.with_times(np.unique(inner))
            marched = march(indenter, fine, medium)
            last = np.searchsorted(fine.time, load.time, side="right") - 1
            found, expected = (getattr(each, "force" if load.by_depth else "depth") for each in (marched, motion))
            # At steps the states after them are compared.
            compared = np.diff(load.time, append=np.inf) > 0
            errors.append(np.abs(found[last] - expected)[compared].max() / np.abs(expected).max())
        assert errors[1] < 1e-11 or (errors[1] < 2e-3 and errors[1] < 0.3 * errors[0]), (name, errors)


@pytest.mark.parametrize("control", ["force", "depth"])
@pytest.mark.parametrize("name", SPRINGS_AND_DASHPOTS)
def test_samples_of_a_linear_history_do_not_matter(name, control):
    curve = indent(self_affine_disc(0.7, 33, rms=0.01, seed=3))
    medium = SPRINGS_AND_DASHPOTS[name]
    scale = 0.5 * curve.depth[-1] if control == "depth" else 0.1 * curve.force[-1]
    load = history(control, steps=name not in ("newtonian", "kelvin-voigt"), scale=scale)
    more, _ = load.with_times(np.union1d(load.time, np.linspace(0, 4, 301)))
    times = np.array([0.5, 1.2, 1.8, 2.2, 2.8, 3.5])
    few, many = kinetics(curve, load, medium, times), kinetics(curve, more, medium, times)
    for name in ("depth", "force", "velocity", "contact_fraction"):
        values = getattr(few, name)
        np.testing.assert_allclose(getattr(many, name), values, rtol=0, atol=1e-9 * np.abs(values).max())


def test_samples_between_turns_do_not_change_the_spectrum_of_a_springpot():
    """The springs and dashpots that replace it depend on the turns of the history: results agree to rounding."""
    curve = indent(self_affine_disc(0.7, 33, rms=0.01, seed=3))
    medium = Springpot(1.0, 0.05)
    force = 0.05 * curve.force[-1] / float(medium.creep_compliance(1.0))
    load = Load([0.0, 0.0, 1.0, 2.0, 3.0], force=[0.0, force, force, 0.3 * force, 0.8 * force])
    more, _ = load.with_times(np.linspace(0.0, 3.0, 16))
    few, many = kinetics(curve, load, medium, [1.0, 2.0, 3.0]), kinetics(curve, more, medium, [1.0, 2.0, 3.0])
    np.testing.assert_allclose(many.depth, few.depth, rtol=1e-13)


@pytest.mark.parametrize("name", ["prony", "springpot"])
def test_forces_fall_along_the_row_after_a_long_rest(name):
    """The first springs are soft and touch at once, closer in time than the rounding of the time since the start."""
    curve = curve_of_body(BODIES["sphere"], np.geomspace(1e-9, 0.2, 301))
    medium = Prony(0.0, [300.0, 3.0, 600.0, 60.0], [2e-3, 1e-4, 0.2, 1e-3]) if name == "prony" else Springpot(1.0, 0.4)
    rest, ramp = 100.0, 1e-4
    force = 0.05 * curve.force[-1] / float(medium.creep_compliance(ramp))
    load = Load([0.0, rest, rest + ramp, rest + 2 * ramp], force=[0.0, 0.0, force, 0.3 * force])
    moved = row_motion(curve, row_of_springs(curve), medium.spectrum(load), load)
    assert np.diff(moved.pressures).max() <= 1e-12 * moved.pressures.max()


@pytest.mark.parametrize("exponent", [0.3, 0.955])
def test_force_is_continuous_where_a_depth_begins_to_retreat(exponent):
    """A springpot relaxes fast at first, and springs let go soon after the turn, but not at it."""
    curve = curve_of_body(BODIES["sphere"], np.geomspace(1e-5, 0.2, 101))
    load = Load([0.0, 1.0, 2.0, 3.0], depth=[0.0, 0.1, 0.1, 0.0])
    motion = kinetics(curve, load, Springpot(1.0, exponent), [2 - 1e-7, 2.0])
    assert motion.force[1] == pytest.approx(motion.force[0], rel=1e-6)
    assert motion.contact_fraction[1] == motion.contact_fraction[0]


def test_default_curves_are_fine_enough():
    """The load has peaks at shares of the last depth. The reference is a curve of many levels."""
    disc, medium = self_affine_disc(0.7, 65, rms=0.01, seed=5), SPRINGS_AND_DASHPOTS["solid"]
    curve = indent(disc)
    fine = indent(disc, tolerance=1e-7, depths=np.geomspace(curve.depth[0], curve.depth[-1], 2000))
    for share in (0.9, 0.3, 0.1, 0.03):
        load = Load([0, 1, 1.6, 2.5], depth=share * curve.depth[-1] * np.array([0, 1, 0.2, 0.9]))
        times = np.linspace(0, 2.5, 101)
        found, expected = (kinetics(each, load, medium, times).force for each in (curve, fine))
        assert np.abs(found - expected).max() < 5e-4 * expected.max()


def test_motions_that_overflow_are_refused():
    curve = indent(self_affine_disc(0.7, 9, rms=0.1, seed=1), until_fraction=1.0)
    for load in (1e300, Load([0, 1, 2.0], force=[0, 1e300, 0])):
        for medium in (1e-300, MEDIA["springpot"].__class__(1e-300, 0.5)):
            with refused("load: depths or forces overflow in this medium"):
                kinetics(curve, load, medium, [1.0, 2.0])


def test_curve_that_begins_late_gives_a_warning():
    curve = curve_of_body(BODIES["sphere"], np.geomspace(0.1, 1, 50))
    load = Load([0, 1, 2.0], depth=[0.0, 0.2, 0.0])
    with pytest.warns(AccuracyWarning, match="depends on the curve before its first level"):
        motion = kinetics(curve, load, MEDIA["solid"], [0.2, 0.9, 1.1])
    np.testing.assert_array_equal(np.isnan(motion.force), [True, False, False])
    load = Load([0, 1, 3.0], force=[0.0, 3 * curve.force[10], 0.0])
    with pytest.warns(AccuracyWarning, match="depends on the curve before its first level"):
        motion = kinetics(curve, load, MEDIA["solid"], [0.01, 0.9, 1.1, 2.9])
    np.testing.assert_array_equal(np.isnan(motion.depth), [True, False, False, True])
    np.testing.assert_array_equal(np.isnan(motion.velocity), [True, False, False, True])


@pytest.mark.parametrize("name", MEDIA)
def test_force_falls_at_a_step_out_of_the_surface(name):
    """A step out of the surface leaves no force in media without instantaneous deflection, and less force in others."""
    medium = MEDIA[name]
    curve = curve_of_body(BODIES["sphere"], np.geomspace(1e-5, 1, 201))
    load = Load([0, 1, 1, 2.0], depth=[0, 0.1, 0.08, 0.08])
    run = partial(kinetics, curve, load, medium)
    before, after = run().force[1:3]
    assert 0 <= after < before
    if not medium.creep_compliance(0.0) > 0:
        assert after == 0


def test_depth_follows_a_force_that_vanishes():
    """The depth reaches its limit as the square root of the force. Thousands of springs lose contact on the way."""
    curve = curve_of_body(BODIES["cone"], np.geomspace(1e-7, 1, 271))
    medium, short = StandardLinearSolid(1.5e-4, 5e-7, 0.165), 1e-9
    load = Load([0.0, 0.25, 0.3, 0.4, 0.5], force=1e-5 * np.array([4, 8, 3, 0, 0]))
    before, after = kinetics(curve, load, medium, [0.4 - short, 0.4]).depth
    assert after == pytest.approx(before, rel=1e-4)


# ---- reloads from zero, and records that begin above zero


@pytest.mark.parametrize("name", ["maxwell", "fluid"])
def test_depth_is_continuous_where_a_reload_begins(name):
    """A fluid keeps its imprint, so all springs touch again as soon as the force rises from zero."""
    medium = {"maxwell": MEDIA["maxwell"], "fluid": Prony(0.0, [2.0, 1.0], [0.1, 3.0])}[name]
    times, shape = np.array([0.0, 60, 72, 130, 190]), np.array([0.0, 1, 1, 0, 1])
    for seed in range(4):
        curve = indent(self_affine_disc(0.4, 17, rms=0.02, seed=seed), until_fraction=0.9)
        force = 0.25 * curve.force[-1] / medium.creep_compliance(130.0)
        motion = kinetics(curve, Load(times, force=force * shape), medium, [130 - 1e-7, 130, 130 + 1e-7])
        np.testing.assert_allclose(motion.depth, motion.depth[0], rtol=1e-6)


@pytest.mark.parametrize("name", ["newtonian", "kelvin-voigt", "springpot"])
def test_record_that_begins_above_zero_by_noise_has_a_ramp_before_it(name):
    """In these media a step of the depth needs an infinite force."""
    curve = curve_of_body(BODIES["sphere"], np.geomspace(1e-5, 0.2, 301))
    times, medium = np.linspace(1.0, 2.0, 41), MEDIA[name]
    depth = 0.1 * (times - 1.0) + 1e-3 * np.random.default_rng(3).random(times.size)
    motion = kinetics(curve, Load(times, depth=depth), medium)
    with_ramp = kinetics(curve, Load(np.append(0.975, times), depth=np.append(0.0, depth)), medium)
    np.testing.assert_array_equal(motion.time, times)
    np.testing.assert_allclose(motion.force, with_ramp.force[1:], rtol=1e-12)
    between = kinetics(curve, Load(times, depth=depth), medium, times[:9])  # other samples than those of the record
    np.testing.assert_allclose(between.force[:-1], motion.force[:8], rtol=1e-9)
    assert np.isfinite(motion.force).all()


def test_intended_step_of_the_depth_stays_a_step():
    curve = curve_of_body(BODIES["sphere"], np.geomspace(1e-5, 0.2, 301))
    held = [0.1, 0.1, 0.1], MEDIA["springpot"], [0.0, 0.5, 1.0]
    motion = kinetics(curve, depth=held[0], medium=held[1], times=held[2])
    expected = curve.at_depth(0.1)[0] * MEDIA["springpot"].relaxation_modulus(np.array([0.5, 1.0]))
    np.testing.assert_allclose(motion.force[1:], expected, rtol=1e-4)
    with refused("steps into the surface at time 0, which takes an infinite force"):
        kinetics(curve, depth=held[0], medium=MEDIA["newtonian"], times=held[2])
