"""Fits of springs and dashpots to samples, against the media that the samples come from."""

import numpy as np
import pytest

from support.media import SPRINGS_AND_DASHPOTS
from viscorough import CreepTable, Load, StandardLinearSolid
from viscorough.media.free_form import creep_columns, fit_creep, fit_relaxation, relaxation_columns
from viscorough.media.table import FreeForm, RelaxationTable, free_form_of

TIMES = np.geomspace(1e-3, 1e2, 60)
COMPLIANCES = {
    "power law": lambda t: t**0.4,
    "logarithm": lambda t: 1 + np.log1p(t),
    "one time": lambda t: 1 - 0.8 * np.exp(-t / 1.13),
    "two times": lambda t: 1 - 0.3 * np.exp(-t / 0.02) - 0.3 * np.exp(-t / 2.0) + 0.01 * t,
    "dashpot": lambda t: 3 * t,
    "spring": lambda t: 2 + 0 * t,
}


@pytest.mark.parametrize("rows", [60, 600])
@pytest.mark.parametrize("name", COMPLIANCES)
def test_fit_meets_the_compliance_of_relaxing_media(name, rows):
    """Between the rows and from 0.3 of the first time on, too."""
    times = np.geomspace(1e-3, 1e2, rows)
    fit = fit_creep(times, COMPLIANCES[name](times))
    between = np.geomspace(3e-4 if name != "power law" else 1e-3, 1e2, 997)
    found = creep_columns(between, fit.times) @ [fit.first, fit.second, *fit.strengths]
    assert np.abs(fit.errors).max() < 1e-9
    np.testing.assert_allclose(found, COMPLIANCES[name](between), rtol=1e-6)


@pytest.mark.parametrize("name", COMPLIANCES)
def test_fit_smooths_noise(name):
    """The misfit to the true compliance is below the noise."""
    times, random = np.geomspace(1e-3, 1e2, 600), np.random.default_rng(2)
    exact = COMPLIANCES[name](times)
    noisy = exact * (1 + 0.01 * random.standard_normal(times.size))
    fit = fit_creep(times, noisy)
    found = creep_columns(times, fit.times) @ [fit.first, fit.second, *fit.strengths]
    assert np.sqrt(np.mean((found / exact - 1) ** 2)) < 0.004


@pytest.mark.parametrize("seed", range(5))
def test_noise_makes_no_elements_faster_than_the_first_row(seed):
    """Such an element could have any strength, so that the modulus at time 0 was wrong by orders of magnitude."""
    solid = SPRINGS_AND_DASHPOTS["solid"]
    noise = 1 + 0.01 * np.random.default_rng(seed).standard_normal(TIMES.size)
    for table in (
        CreepTable(TIMES, solid.creep_compliance(TIMES) * noise),
        RelaxationTable(TIMES, solid.relaxation_modulus(TIMES) * noise),
    ):
        assert table.relaxation.instantaneous_modulus == pytest.approx(4.0, rel=0.1)


def test_fit_misses_a_compliance_that_no_relaxing_medium_has():
    assert np.abs(fit_creep(TIMES, np.minimum(TIMES, 1.0)).errors).max() > 0.2


@pytest.mark.parametrize("name", ["maxwell", "solid", "prony"])
def test_relaxation_modulus_gives_the_compliance(name):
    medium, random = SPRINGS_AND_DASHPOTS[name], np.random.default_rng(4)
    last = 10.0 if name == "maxwell" else 1e2
    times = np.geomspace(1e-3, last, 200)
    exact = medium.relaxation_modulus(times)
    fit = fit_relaxation(times, exact)
    np.testing.assert_allclose(relaxation_columns(times, fit.times) @ [fit.first, *fit.strengths], exact, rtol=1e-8)
    fitted = free_form_of(fit.relaxation)
    np.testing.assert_allclose(fitted.creep_compliance(times), medium.creep_compliance(times), rtol=1e-5)
    noisy = fit_relaxation(times, exact * (1 + 0.01 * random.standard_normal(times.size)))
    smooth = free_form_of(noisy.relaxation).relaxation_modulus(times)
    assert np.sqrt(np.mean((smooth / exact - 1) ** 2)) < 0.005


# ---- the medium


def relaxance_times_compliance(medium, rates):
    """Return Q(s) · s Ĵ(s), which is 1 for every s: J and ψ are inverse under convolution. All terms are positive."""
    viscosity, relaxed, moduli, times = medium.relaxation
    x = rates[:, None] * times
    relaxance = relaxed + viscosity * rates + (moduli * x / (1 + x)).sum(axis=1)
    instantaneous, fluidity, compliances, times = medium.retardation
    return relaxance * (instantaneous + fluidity / rates + (compliances / (1 + rates[:, None] * times)).sum(axis=1))


@pytest.mark.parametrize("seed", range(30))
def test_both_spectra_belong_to_the_same_medium(seed):
    random = np.random.default_rng([70, seed])
    count = int(random.integers(0, 12))
    spring, dashpot = random.choice([0.0, 1.0], 2)
    strengths = 10 ** random.uniform(-9, 3, count + 2) * [spring, dashpot, *np.ones(count)]
    if not strengths.any():
        strengths[0] = 1.0
    medium = FreeForm(*strengths[:2], strengths[2:], 10 ** random.uniform(-6, 6, count))
    rates = np.geomspace(1e-9, 1e9, 200)
    np.testing.assert_allclose(relaxance_times_compliance(medium, rates), 1, rtol=1e-11)


def test_free_form_of_a_solid_is_the_solid():
    solid, times = StandardLinearSolid(4.0, 1.0, 0.5), np.geomspace(1e-3, 1e2, 30)
    medium = FreeForm(0.25, 0.0, [0.75, 0.0], [2.0, 7.0])
    for name in ("creep_compliance", "relaxation_modulus"):
        np.testing.assert_allclose(getattr(medium, name)(times), getattr(solid, name)(times), rtol=1e-13)
    assert medium.compliances.tolist() == [0.75]


def test_compliance_is_unknown_outside_the_known_times():
    medium = FreeForm(1.0, 1.0, [], [], first_time=0.1, last_time=10.0)
    found = medium.creep_compliance([0.0, 0.1, 10.0, 11.0])
    np.testing.assert_array_equal(np.isnan(found), [True, False, False, True])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.0, 0.0, [], []), "not all 0"),
        ((1.0, 0.0, [-1.0], [1.0]), "0 or more"),
        ((1.0, 0.0, [1.0], [1.0, 2.0]), "the same length"),
    ],
)
def test_impossible_free_forms_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        FreeForm(*arguments)


# ---- tables


@pytest.mark.parametrize("rows", [60, 600])
def test_tables_of_a_solid_are_the_solid(rows):
    """Tables may begin at 0 or later; J is unknown outside their rows."""
    solid, times = SPRINGS_AND_DASHPOTS["solid"], np.geomspace(1e-3, 1e2, rows)
    between = np.geomspace(1e-3, 1e2, 77)
    for table in (
        CreepTable(times, solid.creep_compliance(times)),
        CreepTable(np.append(0, times), solid.creep_compliance(np.append(0, times))),
        RelaxationTable(times, solid.relaxation_modulus(times)),
    ):
        np.testing.assert_allclose(table.creep_compliance(between), solid.creep_compliance(between), rtol=1e-7)
        assert np.isnan(table.creep_compliance([0.0, 101.0])).tolist() == [table.first_time > 0, True]
        spectrum, misfit = table.spectrum(Load([0.0, 50.0], force=[1.0, 1.0]))
        assert misfit < 1e-8
        assert spectrum.instantaneous + (spectrum.flows / spectrum.decays).sum() == pytest.approx(1 / 1.5, rel=1e-7)


def test_misfit_is_the_largest_during_the_load():
    noise = 0.01 * np.random.default_rng(1).standard_normal(TIMES.size)
    noise[-1] = 0.08
    table = CreepTable(TIMES, (1 + TIMES**0.3) * (1 + noise))
    shorter, longer = (table.spectrum(Load([0.0, last], force=[1.0, 1.0]))[1] for last in (10.0, 100.0))
    assert 0.01 < shorter < 0.03 < longer < 0.1


def test_table_without_creep_is_a_spring():
    table = CreepTable([0.0, 1.0, 5.0], [2.0, 2.0, 2.0])
    assert table.relaxation.instantaneous_modulus == pytest.approx(0.5, rel=1e-10)
    assert table.relaxation_modulus(5.0) == pytest.approx(0.5, rel=1e-10)


def kinked(times, share):
    """Return a concave compliance with a kink, which no relaxing medium has."""
    return (1 - share) * (1 + np.log1p(times)) + share * np.minimum(times, 1.0)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: CreepTable([0.0], [1.0]), "times: 1, from 0 on; allowed: two or more"),
        (lambda: CreepTable([-1.0, 1.0], [1.0, 2.0]), "times: 2, from -1 on; allowed: two or more, from 0 on"),
        (lambda: CreepTable([0, 1, 1], [1, 2, 3]), "each larger than the one before"),
        (lambda: CreepTable([0, 1, 2], [1, 2]), r"allowed: a number for each time, shape \(3,\)"),
        (lambda: CreepTable([0, 1], ["1", "2"]), "compliances: '1' is a text without a unit"),
        (lambda: CreepTable([0, 1], [0, -1]), "at least one of them above 0"),
        (lambda: CreepTable([0, 1], [1, np.nan]), "allowed: finite numbers"),
        (lambda: CreepTable([0, 1, 2], [2, 1, 0.5]), "CreepTable: springs and dashpots miss it by 42 % at time 0"),
        (lambda: CreepTable([0, 1, 2], [0, 1, 3]), "CreepTable: springs and dashpots miss it by 23 % at time 2"),
        (lambda: CreepTable(TIMES, kinked(TIMES, 1.0)), "miss it by 32 % at time 0.924915; allowed: 10 %"),
        (lambda: CreepTable(TIMES, kinked(TIMES, 0.3)), "which is more than its scatter; allowed: tables of a medium"),
        (lambda: RelaxationTable([0, 1, 2], [1, 2, 4]), "RelaxationTable: springs and dashpots miss it"),
    ],
)
def test_tables_of_no_relaxing_medium_are_refused(make, message):
    with pytest.raises(ValueError, match=message) as refusal:
        make()
    assert "\n" not in str(refusal.value)


def test_elements_of_equal_times_are_one_element():
    """A fit whose times are free may move two elements to the same time, as for a springpot that recedes."""
    medium = FreeForm(1.0, 0.0, [2.0, 1.0, 3.0], [5.0, 1.0, 5.0])
    np.testing.assert_array_equal(medium.retardation_times, [1.0, 5.0])
    np.testing.assert_array_equal(medium.compliances, [1.0, 5.0])
