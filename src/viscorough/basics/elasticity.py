"""Convert Young's modulus E and Poisson ratio ν to the shear modulus G that the solvers use.

Contact without friction depends on E/(1 − ν²) alone. A half-space is therefore as stiff as an incompressible
half-space with the shear modulus

    G = E/(1 − ν²)/4, which is E/3 if ν = 1/2.

In a linear viscoelastic medium with a constant Poisson ratio, this relation holds at every time. A contact therefore
responds as on an incompressible medium. The shear moduli and shear viscosities of the incompressible medium are
obtained if the shear moduli E/(2(1 + ν)) and shear viscosities of the given medium are divided by 2(1 − ν).
"""

import math
from typing import Any

from viscorough.basics import units
from viscorough.basics.argument_names import spelled

INCOMPRESSIBLE = 0.5  # Poisson ratio of an incompressible medium
# K₀₀ = πE*u/(pd), where u is the deflection at the centre of a square of side d under the uniform pressure p. The
# modulus is E* = E/(1 − ν²).
UNIT_SQUARE_DEFLECTION = 4 * math.log(1 + math.sqrt(2))


def shear_modulus_of(
    length_unit: str, shear_modulus: Any = None, young_modulus: Any = None, poisson: Any = None
) -> float | None:
    """Return G of the incompressible half-space that is as stiff as the given half-space; None without a modulus.

    shear_modulus, young_modulus : G or E in Pa, or with a unit; in consistent units if the unit of length is not known
    poisson : Poisson ratio ν, allowed only together with Young's modulus; default: 0.5

    Raises ValueError, which names the argument, for numbers out of range, and for arguments that exclude each other.
    """
    from viscorough.basics.arrays import (
        positive,  # imported here, so that the command line can read its options before the slow import of numpy
    )

    names = {"shear_modulus": spelled("--shear-modulus", "shear_modulus"), "young": spelled("--young", "young_modulus")}
    if shear_modulus is not None and young_modulus is not None:
        raise ValueError(f"{' and '.join(names.values())} exclude each other; one of them is allowed")
    if young_modulus is None:
        if poisson is not None:
            raise ValueError(f"{spelled('--poisson', 'poisson')} is for use with {names['young']}")
        if shear_modulus is None:
            return None
        return positive(names["shear_modulus"], units.number(shear_modulus, "Pa", length_unit, names["shear_modulus"]))
    ratio = poisson_ratio(spelled("--poisson", "poisson"), poisson)
    modulus = positive(names["young"], units.number(young_modulus, "Pa", length_unit, names["young"]))
    return modulus / young_over_shear(ratio)


def poisson_ratio(name: str, value: Any) -> float:
    """Return a Poisson ratio ν as a float; 0.5 for None.

    Raises ValueError, with a message that starts with `name`, unless −1 < ν ≤ 0.5.
    """
    from viscorough.basics.arrays import real_number

    ratio = INCOMPRESSIBLE if value is None else real_number(name, value)
    if not -1 < ratio <= INCOMPRESSIBLE:
        raise ValueError(f"{name}: must be above -1 and at most 0.5, not {ratio!r}")
    return ratio


def young_over_shear(poisson: float) -> float:
    """Return E/G = 4(1 − ν²), where G is the shear modulus of an incompressible medium with the same contact stiffness.

    E and ν are Young's modulus and the Poisson ratio of the given medium. The two media have the same E/(1 − ν²).
    """
    return 4 * (1 - poisson**2)


def shear_over_incompressible(poisson: float) -> float:
    """Return 2(1 − ν), the shear modulus of a medium divided by that of an incompressible medium of equal stiffness.

    Contacts respond in the same way on both media. The shear viscosities have the same ratio.
    """
    return 2 * (1 - poisson)


def one_element_stiffness(elements_across: int) -> float:
    """Return the reduced stiffness κ = k/(E*L) = π/(K₀₀ n) of an indenter with one square element in contact.

    n is the number of elements across the diameter L of the indenter. Under the uniform pressure p, the centre of a
    square of side d = L/n sinks by u = pd K₀₀/(πE*). One element is in contact in region (a) of the paper, where
    vt/h = X/κ; `viscorough.reference` defines X.

    Examples
    --------
    >>> from viscorough import reference
    >>> round(reference.one_element_stiffness(11), 3)
    0.081
    """
    from viscorough.basics.arrays import whole_number

    return math.pi / (UNIT_SQUARE_DEFLECTION * whole_number("elements_across", elements_across, at_least=1))
