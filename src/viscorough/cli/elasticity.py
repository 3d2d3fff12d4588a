"""Options for the half-space's elastic constants, and what forces are in terms of the solver's F/G."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import click

from viscorough import units
from viscorough.cli.options import PositiveNumber, QuantityOption, number_in
from viscorough.units import Quantity


def elastic_constants_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add --shear-modulus, --young and --poisson to a command."""
    ratio = PositiveNumber(0.5, above=-1)
    command = click.option("--poisson", type=ratio, help="Poisson ratio, with --young  [default: 0.5]")(command)
    command = click.option("--young", type=QuantityOption("Pa"), help="Young's modulus, instead of G.")(command)
    text = "Shear modulus G of the incompressible half-space."
    return click.option("--shear-modulus", type=QuantityOption("Pa"), help=text)(command)


def elasticity(
    shear_modulus: Quantity | None, young: Quantity | None, poisson: float | None, length_unit: str
) -> tuple[float | None, dict[str, float]]:
    """(G, what was stated, for files) of the options; G is None if no modulus was stated.

    G is that of the incompressible half-space with the same E* = E/(1 − ν²) = 4G [Pa, or consistent units].

    Raises UsageError if the options contradict each other.
    """
    if shear_modulus is not None and young is not None:
        raise click.UsageError("--shear-modulus and --young exclude each other; one of them is allowed")
    if poisson is not None and young is None:
        raise click.UsageError("--poisson is for use with --young")
    if young is not None:
        poisson = 0.5 if poisson is None else poisson
        modulus = number_in("Pa", young, length_unit, "--young")
        return modulus / (1 - poisson**2) / 4, {"young_modulus": modulus, "poisson_ratio": poisson}
    if shear_modulus is not None:
        modulus = number_in("Pa", shear_modulus, length_unit, "--shear-modulus")
        return modulus, {"shear_modulus": modulus}
    return None, {}


def forces_over_modulus(
    quantities: Sequence[Quantity], shear_modulus: float | None, length_unit: str, option: str
) -> list[float]:
    """F/G [length²] of forces, Quantities given with an option.

    With a modulus, forces are in N, or in consistent units if the unit of length is not known; without one, they are
    F/G. Raises UsageError for a force with a unit where no modulus or no unit of length is known.
    """
    try:
        return list(units.forces_over_modulus(quantities, shear_modulus, length_unit, option))
    except ValueError as error:
        raise click.UsageError(str(error)) from error


def lengths(quantities: Sequence[Quantity], length_unit: str, option: str) -> list[float]:
    """Numbers in the unit of length of the indenter, of Quantities given with an option."""
    return [number_in(length_unit, quantity, length_unit, option) for quantity in quantities]
