"""One medium of every kind, on comparable scales of time and modulus."""

from viscorough.media.kinds import KelvinVoigt, Maxwell, Newtonian, Prony, Springpot, StandardLinearSolid

SPRINGS_AND_DASHPOTS = {
    "newtonian": Newtonian(3.0),
    "maxwell": Maxwell(2.0, 5.0),
    "kelvin-voigt": KelvinVoigt(2.0, 5.0),
    "solid": StandardLinearSolid(4.0, 1.5, 0.3),
    "prony": Prony(0.5, [10.0, 1.0, 3.0], [0.4, 1.0, 50.0]),
}
MEDIA = SPRINGS_AND_DASHPOTS | {"springpot": Springpot(2.0, 0.4)}
