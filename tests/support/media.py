"""One medium of every kind, on comparable scales of time and modulus."""

import numpy as np

from viscorough.media.kinds import KelvinVoigt, Maxwell, Newtonian, Prony, Springpot, StandardLinearSolid
from viscorough.media.medium import Medium
from viscorough.media.table import CreepTable

SPRINGS_AND_DASHPOTS = {
    "newtonian": Newtonian(3.0),
    "maxwell": Maxwell(2.0, 5.0),
    "kelvin-voigt": KelvinVoigt(2.0, 5.0),
    "solid": StandardLinearSolid(4.0, 1.5, 0.3),
    "prony": Prony(0.5, [10.0, 1.0, 3.0], [0.4, 1.0, 50.0]),
}
TABLE_TIMES = np.append(0, np.geomspace(0.01, 100, 40))
MEDIA = SPRINGS_AND_DASHPOTS | {
    "springpot": Springpot(2.0, 0.4),
    "table": CreepTable(TABLE_TIMES, 0.2 + TABLE_TIMES**0.3),
}


class Wrapped(Medium):
    """A medium that is given by its creep compliance alone."""

    def __init__(self, inner):
        self.inner = inner

    def creep_compliance(self, time):
        return self.inner.creep_compliance(time)
