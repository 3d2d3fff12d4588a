"""Convert Young's modulus E and Poisson ratio ν to the shear modulus G that the solvers use.

Contact without friction depends on E/(1 − ν²) alone. A half-space is therefore as stiff as an incompressible
half-space with the shear modulus

    G = E/(1 − ν²)/4, which is E/3 if ν = 1/2.

In a linear viscoelastic medium with a constant Poisson ratio, this relation holds at every time. A contact therefore
responds as on an incompressible medium. The shear moduli and shear viscosities of the incompressible medium are
obtained if the shear moduli E/(2(1 + ν)) and shear viscosities of the given medium are divided by 2(1 − ν).
"""

import math

INCOMPRESSIBLE = 0.5  # Poisson ratio of an incompressible medium
# K₀₀ = πE*u/(pd), where u is the deflection at the centre of a square of side d under the uniform pressure p. The
# modulus is E* = E/(1 − ν²).
UNIT_SQUARE_DEFLECTION = 4 * math.log(1 + math.sqrt(2))


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
    from viscorough.basics.arrays import whole_number  # imports numpy, which the command line does without at first

    return math.pi / (UNIT_SQUARE_DEFLECTION * whole_number("elements_across", elements_across, at_least=1))
