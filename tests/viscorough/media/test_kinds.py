"""Media: compliance and modulus against closed forms and against each other, and refusals."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from scipy.special import beta

from support.contract import refused
from support.media import MEDIA, SPRINGS_AND_DASHPOTS
from viscorough import KelvinVoigt, Maxwell, Newtonian, Prony, Springpot, StandardLinearSolid
from viscorough.io.medium_files import medium_from_mapping

TIMES = np.append(0, np.geomspace(1e-9, 1e6, 60))


def relaxance_times_compliance(medium, rates):
    """Return Q(s) · s Ĵ(s), which is 1 for every s: J and ψ are inverse under convolution. All terms are positive."""
    viscosity, relaxed, moduli, times = medium.relaxation
    x = rates[:, None] * times
    relaxance = relaxed + viscosity * rates + (moduli * x / (1 + x)).sum(axis=1)
    instantaneous, fluidity, compliances, times = medium.retardation
    return relaxance * (instantaneous + fluidity / rates + (compliances / (1 + rates[:, None] * times)).sum(axis=1))


def random_prony(seed):
    """Return up to twelve branches, with moduli and times over many decades, or with nearly equal times."""
    random = np.random.default_rng(seed)
    branches = random.integers(1, 13)
    times = 10 ** random.uniform(*((-8, 8) if seed % 3 else (0, 1e-6)), branches)
    return Prony(random.choice([0, 10 ** random.uniform(-5, 5)]), 10 ** random.uniform(-5, 5, branches), times)


SPECTRA = SPRINGS_AND_DASHPOTS | {
    "moduli ten decades apart": Prony(0.0, [1e10, 1.0], [1e-6, 1e6]),
    "a weak branch in the middle": Prony(1e5, [1e5, 1e-5, 1e5], [1e-3, 1.0, 1e3]),
    "equal times": Prony(1.0, [2.0, 3.0, 4.0], [0.5, 0.5, 2.0]),
    **{f"random {seed}": random_prony(seed) for seed in range(12)},
}


@pytest.mark.parametrize("name", SPECTRA)
def test_creep_is_the_inverse_of_relaxation(name):
    rates = np.geomspace(1e-12, 1e12, 200)
    np.testing.assert_allclose(relaxance_times_compliance(SPECTRA[name], rates), 1, rtol=1e-12)
    assert (SPECTRA[name].retardation.compliances > 0).all()


def test_compliance_and_modulus_follow_closed_forms():
    t = TIMES
    np.testing.assert_allclose(Newtonian(3.0).creep_compliance(t), t / 3, rtol=1e-15)
    np.testing.assert_allclose(Maxwell(2.0, 5.0).creep_compliance(t), 0.5 + t / 5, rtol=1e-15)
    np.testing.assert_allclose(Maxwell(2.0, 5.0).relaxation_modulus(t), 2 * np.exp(-t / 2.5), rtol=1e-15)
    np.testing.assert_allclose(KelvinVoigt(2.0, 5.0).creep_compliance(t), -np.expm1(-t / 2.5) / 2, rtol=1e-15)
    solid = StandardLinearSolid(4.0, 1.5, 0.3)
    expected = 1 / 1.5 - (1 / 1.5 - 1 / 4) * np.exp(-t / (0.3 * 4 / 1.5))
    np.testing.assert_allclose(solid.creep_compliance(t), expected, rtol=1e-14)
    np.testing.assert_allclose(solid.relaxation_modulus(t), 1.5 + 2.5 * np.exp(-t / 0.3), rtol=1e-15)


@pytest.mark.parametrize("a", [0.05, 0.5, 0.95])
def test_springpot_compliance_and_modulus_are_inverse(a):
    """ψ and J are inverse, so ∫ψ(t − s) J(s) ds = t, with ∫(t − s)^(−a) s^a ds = t B(1 − a, 1 + a)."""
    medium = Springpot(2.5, a)
    for t in (0.1, 3.0):
        product = medium.relaxation_modulus(t) * medium.creep_compliance(t)
        assert product * beta(1 - a, 1 + a) == pytest.approx(1, rel=1e-14)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Newtonian(0), "^Newtonian: viscosity: must be a positive number, not 0$"),
        (lambda: Maxwell(np.nan, 1.0), "^Maxwell: shear_modulus: must be a positive number, not nan$"),
        (lambda: KelvinVoigt(1.0, np.inf), "^KelvinVoigt: viscosity: must be a positive number, not inf$"),
        (lambda: Springpot(True, 0.5), "^Springpot: modulus: must be a positive number, not True$"),
        (lambda: Springpot(1.0, [0.5]), r"^Springpot: exponent: must be a positive number, not \[0.5\]$"),
        (
            lambda: StandardLinearSolid(2.0, 1.0, "one"),
            "relaxation_time: must be a positive number, not 'one'$",
        ),
        (lambda: StandardLinearSolid(1.0, 1.0, 1.0), "below instantaneous_modulus, 1"),
        (lambda: Springpot(1.0, 1.0), "below 1"),
        (lambda: Springpot(1e-310, 0.5), "inverse is finite"),
        (lambda: Prony(-1.0, [1.0], [1.0]), "0 or a finite number above 0"),
        (lambda: Prony(1.0, [], []), "a list of one or more numbers"),
        (lambda: Prony(1.0, [1.0, 0.0], [1.0, 2.0]), r"moduli\[1\]: must be a positive number, not 0.0"),
        (lambda: Prony(1.0, [1.0, 1.0], [1.0]), "one time for every modulus"),
        (lambda: Maxwell(1e-300, 1e300), "too far apart"),
    ],
)
def test_invalid_parameters_are_refused(make, message):
    with refused(message):
        make()


def read(**mapping):
    return medium_from_mapping(mapping, "um")


def test_values_with_a_unit_are_converted_to_si():
    assert read(kind="maxwell", shear_modulus="2 MPa", viscosity="3 kPa s") == Maxwell(2e6, 3e3)
    prony = read(kind="prony", relaxed_modulus="1 kPa", moduli=["2 kPa", 5.0], relaxation_times=["1 min", "10 ms"])
    assert (prony.relaxed_modulus, prony.moduli, prony.relaxation_times) == (1e3, (2e3, 5.0), (60.0, 0.01))
    with refused("^shear_modulus 1 Pa s: .*Pa s.*Pa"):
        read(kind="kelvin_voigt", shear_modulus="1 Pa s", viscosity=1.0)
    with refused("^modulus: '5 Pa'; allowed: a plain number, since its unit is not fixed"):
        read(kind="springpot", modulus="5 Pa", exponent=0.5)


def test_youngs_moduli_of_incompressible_media_are_three_times_those_in_shear():
    assert read(kind="maxwell", young_modulus="6 MPa", viscosity="3 kPa s") == Maxwell(2e6, 3e3)
    assert read(kind="kelvin_voigt", young_modulus=6, viscosity=5, poisson=0.5) == KelvinVoigt(2.0, 5.0)
    solid = {"instantaneous_young_modulus": 9, "relaxed_young_modulus": 3, "relaxation_time": 0.5}
    assert read(kind="standard_linear_solid", **solid) == StandardLinearSolid(3.0, 1.0, 0.5)
    prony = {"relaxed_young_modulus": 0, "young_moduli": ["3 kPa", 6.0], "relaxation_times": [1.0, 2.0]}
    assert read(kind="prony", **prony) == Prony(0, [1e3, 2.0], [1.0, 2.0])
    assert read(kind="springpot", young_modulus=6.0, exponent=0.5) == Springpot(2.0, 0.5)


def test_a_constant_poisson_ratio_keeps_relaxation_times():
    """A contact sees E(t)/(1 − ν²); the relaxation time is the viscosity over the modulus, both in shear."""
    young, viscosity, ratio = 3.0, 5.0, 0.2
    medium = read(kind="maxwell", young_modulus=young, viscosity=viscosity, poisson=ratio)
    relaxation_time, times = viscosity / (young / (2 * (1 + ratio))), np.linspace(0, 20, 9)
    expected = young * np.exp(-times / relaxation_time) / (1 - ratio**2)
    np.testing.assert_allclose(4 * medium.relaxation_modulus(times), expected, rtol=1e-13)


@pytest.mark.parametrize(
    ("mapping", "message"),
    [
        ({"kind": "maxwell", "viscosity": 1}, r"lacks shear_modulus; maxwell needs shear_modulus \(or young_modulus\)"),
        ({"kind": "maxwell", "young_modulus": 1}, "lacks viscosity"),
        ({"kind": "maxwell", "shear_modulus": 1, "young_modulus": 3, "viscosity": 1}, "exclude each other"),
        ({"kind": "maxwell", "shear_modulus": 1, "viscosity": 1, "poisson": 0.3}, "poisson is for use with young_mod"),
        ({"kind": "maxwell", "young_modulus": 1, "viscosity": 1, "poisson": 0.6}, "poisson: must be above -1 and at"),
        ({"kind": "prony", "young_moduli": [1], "relaxation_times": [1]}, "lacks relaxed_modulus"),
        ({"kind": "newtonian", "viscosity": 1, "poisson": 0.3}, "unknown key 'poisson'; allowed for newtonian: visc"),
        ({"kind": "springs"}, "kind 'springs'; allowed: newtonian, maxwell"),
    ],
)
def test_mappings_that_describe_no_medium_are_refused(mapping, message):
    with refused(message):
        read(**mapping)


@pytest.mark.parametrize("name", MEDIA)
def test_times_may_have_labels_but_no_signs(name):
    medium, times = MEDIA[name], np.array([0.5, 2.0])
    for function in (medium.creep_compliance, medium.creep_rate):
        np.testing.assert_array_equal(function(pd.Series(times, index=[3, 1])), function(times))
        np.testing.assert_array_equal(function(xr.DataArray(times, dims="t")), function(times))
        for wrong, message in (
            (-1.0, "time: -1; allowed: 0 or more"),
            (1j, "real numbers are needed"),
            ([True], "real numbers are needed"),
        ):
            with pytest.raises(ValueError, match=message):
                function(wrong)
