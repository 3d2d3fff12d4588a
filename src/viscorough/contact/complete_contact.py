"""Compute the complete contact of a map from two linear problems, without a contact problem.

If all elements are joined to the surface, so that they also transmit tension, the pressures at the depth u are u q − s
with K q = 1 and K s = g₀. Here g₀ is the initial gap, K the matrix of influence coefficients, and a pressure p is
expressed as the length p d/(4πG), with the side d of an element and the shear modulus G. The solutions give

    ⟨g₀⟩_q = Σs/Σq,   k_c/G = 4π d Σq,   U/G = 2π d (Σ s g₀ − (Σs)²/Σq),   u = max s/q

These are also the exact values of two integrals of the loading curve (docs/theory.md, "Two integrals of every curve"):
the calibration of the penetration law and the tests of curves use them.
"""

from typing import NamedTuple

from viscorough.contact.joined_surface import joined_surface
from viscorough.contact.ranking import all_elements
from viscorough.surfaces.indenter import Indenter


class CompleteContact(NamedTuple):
    """Complete contact of an indenter, and exact values of two integrals of its loading curve.

    mean_gap : exact value ⟨g₀⟩_q of the first integral, the mean initial gap weighted with the pressures of a flat
        punch [length]
    energy : exact value U/G of the second integral, where U is the elastic energy at zero mean force if all elements
        are joined to the surface [length³]
    stiffness : stiffness k_c/G of a flat punch with the outline of the whole indenter [length]
    depth : smallest depth u where all elements touch [length]
    """

    mean_gap: float
    energy: float
    stiffness: float
    depth: float

    @property
    def force(self) -> float:
        """Return the force of complete contact, F/G = k_c (u − ⟨g₀⟩_q)/G [length²]."""
        return self.stiffness * (self.depth - self.mean_gap)


def complete_contact(indenter: Indenter) -> CompleteContact:
    """Compute the complete contact of an indenter with two-dimensional heights.

    Raises ConvergenceError if the linear problems cannot be solved to a relative residual of 1e-12.
    """
    elements = all_elements(indenter)
    units = elements.units
    joined = joined_surface(elements)
    reduced_energy = float(joined.load @ (elements.initial_gap - joined.mean_gap)) / 2
    return CompleteContact(
        mean_gap=joined.mean_gap * units.length,
        energy=units.stiffness * reduced_energy * units.length**2,
        stiffness=units.stiffness * float(joined.tangent.sum()),
        depth=joined.depth * units.length,
    )
