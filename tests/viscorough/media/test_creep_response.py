"""The rate of the creep under force histories against closed forms, and where Φ decreases; Φ itself: test_kinetics."""

from itertools import pairwise

import numpy as np
import pytest

from support.media import MEDIA
from viscorough import KelvinVoigt, Load, LoadingCurve, Prony, kinetics
from viscorough.media.creep_response import creep_response
from viscorough.viscous.crossing import first_decrease

MEDIA = MEDIA | {"prony liquid": Prony(0.0, [1e6, 1.0], [1e-5, 4.0])}
# A ramp, a step up, a hold and a slower ramp.
TIMES = np.array([0.5, 1.0, 2.5, 2.5, 4.0, 9.0])
FORCE = np.array([0.2, 1.0, 1.0, 1.8, 1.8, 2.5])


def rate_from_closed_forms(medium, time, *, after):
    """dΦ/dt right or left of a time: F₀ J'(t − t₀) + ∫ F'(s) J'(t − s) ds, with the integral of J' in closed form."""
    rate = FORCE[0] * medium.creep_rate(time - TIMES[0])
    for (start, end), (first, last) in zip(pairwise(TIMES), pairwise(FORCE), strict=True):
        if start == end:
            rate += (last - first) * medium.creep_rate(time - start) if time > start else 0
        elif start < time or (after and start == time):
            ended = end < time or (after and end == time)
            integral = medium.creep_compliance(time - start) - (medium.creep_compliance(time - end) if ended else 0)
            rate += (last - first) / (end - start) * integral
    return rate


def straight_curve(stiffness=1.0):
    """Return the curve of a single element, whose velocity is Φ'/k."""
    one = np.ones(1)
    return LoadingCurve(one, stiffness * one, stiffness * one, [1], 1, "exact", 0.0, 0, 0 * one)


def creep_rate(medium, times, force):
    """Return dΦ/dt at the samples."""
    return kinetics(straight_curve(), Load(times, force=force), medium).velocity


@pytest.mark.parametrize("name", MEDIA)
def test_velocity_of_a_single_element_is_the_rate_of_creep(name):
    """The rate is known in closed form for ramps and steps: right of a sample, left of the last one and of a step."""
    rate = creep_rate(MEDIA[name], TIMES, 1e-3 * FORCE)
    for sample, after in ((1, True), (2, False), (4, True), (5, False)):
        exact = 1e-3 * rate_from_closed_forms(MEDIA[name], TIMES[sample], after=after)
        assert rate[sample] == pytest.approx(exact, rel=1e-6 if name == "springpot" else 1e-11)


def creep(medium, times, force):
    load = Load(times, force=force)
    return creep_response(medium.spectrum(load), load)


def test_short_and_long_times_lose_no_digits():
    """Steps of 1e-12 and 1e12 retardation times: Φ of a step is J(t), and its rate J'(t)."""
    for medium in (KelvinVoigt(2.0, 5.0), Prony(1.0, [1e10, 1.0], [1e-8, 1e8])):
        for times in (np.linspace(0, 1e-12, 5), np.linspace(0, 50, 5), np.linspace(0, 1e12, 5)):
            found = creep(medium, times, np.ones(5))
            np.testing.assert_allclose(found, medium.creep_compliance(times), rtol=1e-12, atol=0)
            rate = creep_rate(medium, times, 0.1 * np.ones(5))
            np.testing.assert_allclose(rate, 0.1 * medium.creep_rate(times), rtol=1e-11, atol=1e-300)


# ---- where the creep decreases


def receding_from(medium, force, times):
    load = Load(times, force=force)
    return first_decrease(medium.spectrum(load), load.time, load.values)


def test_first_decrease_against_dense_sampling():
    """Random histories in random media, those that recede within an interval and move on before its end included."""
    random, within = np.random.default_rng(4), 0
    for _ in range(100):
        medium = Prony(random.choice([0.0, 1.0]), 10 ** random.uniform(-1, 1, 3), 10 ** random.uniform(-2, 2, 3))
        times = np.append(0, np.cumsum(10 ** random.uniform(-1, 1, 4)))
        force = 1 + 0.05 * random.standard_normal(5) + np.array([0, 0.1, 0, 0, 0.1])
        dense = np.unique(np.concatenate([times, np.linspace(0, times[-1], 4001)]))
        decrease = receding_from(medium, force, times)
        finely = creep_rate(medium, dense, 1e-3 * np.interp(dense, times, force))
        down = np.flatnonzero(finely < -1e-12)
        expected = dense[down[0]] if down.size else np.inf
        decrease = np.inf if np.isnan(decrease) else decrease
        assert decrease <= expected
        assert decrease == expected or decrease > dense[max(down[0] - 1, 0)] - 1e-9
        within += np.isfinite(decrease) and creep_rate(medium, times, 1e-3 * force).min() > 0
    assert within > 0


@pytest.mark.parametrize("name", ["maxwell", "solid", "prony", "prony liquid", "springpot"])
def test_creep_decreases_at_a_step_down_where_the_medium_springs_at_once(name):
    assert receding_from(MEDIA[name], [1.0, 1.0, 0.9, 0.9], [0.0, 1.0, 1.0, 2.0]) == 1.0
