"""Pressures in viscoelastic media against direct integration, which uses neither elastic contacts nor the creep."""

import numpy as np
import pytest

from viscorough.surfaces import self_affine_disc
from viscorough.viscous.correspondence import impulses
from viscorough.viscous.internal_variable_events import march_medium_events
from viscorough.viscous.media import CreepTable, KelvinVoigt, Maxwell, Newtonian, Prony, Springpot, StandardLinearSolid
from viscorough.viscous.pressures import pressure_at

MEDIA = {
    "newtonian": Newtonian(3.0),
    "maxwell": Maxwell(2.0, 5.0),
    "kelvin-voigt": KelvinVoigt(2.0, 5.0),
    "solid": StandardLinearSolid(4.0, 1.5, 0.3),
    "prony": Prony(0.5, [10.0, 1.0, 3.0], [0.4, 1.0, 50.0]),
}


@pytest.fixture(scope="module")
def disc():
    return self_affine_disc(0.7, 17, seed=3)


@pytest.mark.parametrize("name", MEDIA)
def test_pressures_of_a_ramp_and_a_step(disc, name):
    medium, scale = MEDIA[name], 0.5
    times, force = np.array([0, 0.5, 0.5, 2.0]), scale * np.array([0.1, 0.5, 0.8, 1.0])
    events = march_medium_events(disc, medium, times, force=force)
    errors = []
    for contacts in (16, 64):
        pressure = pressure_at(disc, medium, impulses(force, times), 2.0, contacts=contacts, tolerance=1e-8)
        assert (np.isnan(pressure) == np.isnan(disc.heights)).all()
        errors.append(np.nanmax(abs(pressure - events.pressure)) / np.nanmax(events.pressure))
    assert errors[1] < 0.02
    if name in ("maxwell", "solid", "prony"):  # of a dashpot, what remains is that of the last interval
        assert errors[1] < errors[0]
    assert np.nansum(pressure) * disc.spacing**2 == pytest.approx(force[-1], rel=1e-2)


def test_a_step_and_its_hold_are_exact_in_the_sum(disc):
    """The sum of the pressures is the force, in a springpot too, whose elastic part has no share in it at first."""
    for medium in (MEDIA["solid"], Springpot(2.0, 0.4)):
        pressure = pressure_at(disc, medium, 0.5, 3.0, contacts=200)
        assert np.nansum(pressure) * disc.spacing**2 == pytest.approx(0.5, rel=2e-2)
        assert np.nanmin(pressure) >= 0


@pytest.mark.parametrize(
    ("medium", "force", "time", "message"),
    [
        (CreepTable([0, 1], [0, 1]), 1.0, 1.0, "CreepTable; allowed: media whose relaxation is known"),
        (Maxwell(1.0, 1.0), impulses([1.0, 1.0], [0.0, 1.0]), 2.0, "time: 2.0; allowed: within those of the force"),
        (Maxwell(1.0, 1.0), impulses([1.0, 1.0], [0.0, 1.0]), 0.0, "time: 0.0; allowed: within those of the force"),
        (Maxwell(1.0, 2.0), impulses([1.0, 0.0], [0.0, 1.0]), 1.0, "from time 0 on the contact would recede"),
    ],
)
def test_refusals(disc, medium, force, time, message):
    with pytest.raises(ValueError, match=rf"^[^\n]*{message}[^\n]*$"):
        pressure_at(disc, medium, force, time)
