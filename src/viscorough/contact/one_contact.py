"""Solve one contact at a given depth or force and return its maps of pressure and gap, without a loading curve."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.arrays import increasing, real_numbers
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.summaries import with_unit
from viscorough.basics.types import Array, Progress, Scalar, Several
from viscorough.contact.argument_checks import check_solvable, warn_beyond_theory
from viscorough.contact.free_edges import FreeEdges
from viscorough.contact.gap_map import gap_map
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.prescribed_force import ForceSearch
from viscorough.contact.state import ContactState
from viscorough.results.contact_maps import Contact
from viscorough.surfaces.indenter import Indenter

# In the search for the contact at a force, about this share of the time passes until a solved contact has reached the
# force. The rest of the time is for contacts close to the force.
_SHARE_OF_APPROACH = 0.6


@overload
def contact_at(
    indenter: Indenter,
    *,
    force: Scalar | None = None,
    depth: Scalar | None = None,
    tolerance: float = 1e-3,
    progress: Progress | None = None,
    threads: int = 1,
    options: SolverOptions = DEFAULT,
) -> Contact: ...


@overload
def contact_at(
    indenter: Indenter,
    *,
    force: Several | None = None,
    depth: Several | None = None,
    tolerance: float = 1e-3,
    progress: Progress | None = None,
    threads: int = 1,
    options: SolverOptions = DEFAULT,
) -> list[Contact]: ...


def contact_at(
    indenter: Indenter,
    *,
    force: ArrayLike | None = None,
    depth: ArrayLike | None = None,
    tolerance: float = 1e-3,
    progress: Progress | None = None,
    threads: int = 1,
    options: SolverOptions = DEFAULT,
) -> Contact | list[Contact]:
    """Solve the contact of a rigid indenter with an incompressible elastic half-space at a given depth or force.

    `indent` solves the same problem. It is solved at the given depth only, or at the few depths that are needed
    to find the given force.

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    force : array_like, optional
        Force F/G, where G is the shear modulus [length²]. Several forces must increase. Either depth or force must be
        given. A compressible half-space with Young's modulus E and Poisson ratio ν has G = E/(1 − ν²)/4.
    depth : array_like, optional
        Depth u from first contact [length]. Several depths must increase.
    tolerance : float, optional
        Accuracy of the contact, between 1e-12 and 0.1. It bounds the gap in contact and the overlap outside the
        contact, each divided by the depth, with rounding included. The relative errors of the force at a given depth,
        and of the depth at a given force, are far smaller.
    progress : Progress, optional
        Function that is called after each contact with the estimated finished share of the computation, up to 1.
    threads : int, optional
        Number of threads; it does not change the result. Use several for large maps.
    options : SolverOptions, optional
        Details of the iterations, such as their precision; change them only to measure their effect.

    Returns
    -------
    Contact or list[Contact]
        The contact, or a list of contacts for several depths or forces. The pressures times the area of an element add
        up to the force F/G within rounding. Each contact of a list is solved from the previous contact.

    Raises
    ------
    ValueError
        For arguments out of range.
    ConvergenceError
        If a contact cannot be solved to the tolerance.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> contact = viscorough.contact_at(disc, force=0.005)
    >>> round(contact.force, 6)
    0.005
    """
    tolerance = check_solvable("contact_at", indenter, tolerance, threads, options)
    if (depth is None) == (force is None):
        raise ValueError("contact_at: either depth or force must be given")
    by_depth = force is None
    name = "argument depth" if by_depth else "argument force"
    given = real_numbers(name, depth if by_depth else force)
    values = increasing(name, np.atleast_1d(given), above_zero=True)
    # Contacts are solved to half of the tolerance. The other half is left for rescaling the pressures, so that they add
    # up to exactly the force.
    largest_depth = float(values[-1]) if by_depth else np.inf
    solver = ContactSolver(indenter, tolerance / 2, options, threads, largest_depth=largest_depth, whole=False)
    states = (_states_at_depths if by_depth else _states_at_forces)(solver, values, progress or (lambda done: None))
    contacts, edges = [], FreeEdges(solver)
    for value, state in zip(values, states, strict=True):
        edges.see(state)
        # Return the depth or force as given: conversion to reduced units and back would round it.
        depth, force = (float(value), state.force) if by_depth else (state.depth, float(value))
        contacts.append(_with_maps(solver, state, depth, force, tolerance))
    warn_beyond_theory(indenter, contacts[-1].depth)
    edges.warn()
    if text := _completeness_warning(indenter, contacts[-1]):
        warnings.warn(text, AccuracyWarning, stacklevel=2)
    return contacts if np.ndim(given) else contacts[0]


def _states_at_depths(solver: ContactSolver, depths: Array, progress: Progress) -> Iterator[ContactState]:
    """Yield the contacts at depths [length]; each contact is solved from the previous contact.

    The pressures of each contact are rescaled, so that they add up exactly to its force.
    """
    last: ContactState = solver.unloaded_state()
    for number, depth in enumerate(depths, 1):
        last = solver.advance(last, depth)
        yield solver.extrapolate(last, last.reduced_depth, last.pressure_sum)
        progress(number / depths.size)


def _states_at_forces(solver: ContactSolver, forces: Array, progress: Progress) -> Iterator[ContactState]:
    """Yield the contacts at forces F/G [length²]; each contact is solved from the previous contact."""
    search = ForceSearch(solver)
    for number, force in enumerate(forces):
        yield search.contact_at(force, _approach(progress, number, forces.size))
        progress((number + 1) / forces.size)


def _approach(progress: Progress, number: int, size: int) -> Progress:
    """Return a function that reports the progress of the search for the contact at one force.

    The returned function takes the share of the force that is reached so far, from 0 to 1.

    progress : function that takes the finished share of the whole computation
    number, size : number of forces that are finished, and number of all forces
    """
    return lambda share: progress((number + _SHARE_OF_APPROACH * share) / size)


def _with_maps(solver: ContactSolver, state: ContactState, depth: float, force: float, tolerance: float) -> Contact:
    """Return a solved contact with its maps of pressure and gap.

    state : solved contact
    depth, force, tolerance : values to store in the Contact, in its units
    """
    if not np.isfinite(state.force):
        raise ValueError("the force is too large to represent; a larger unit of length is needed")
    indenter, gap, loads = solver.indenter, gap_map(solver, state), state.member_loads()
    pressure = np.where(np.isnan(gap), np.nan, 0.0)
    pressure[solver.elements.places_on_map(loads.members)] = loads.pressure * solver.units.pressure
    contact = pressure > 0
    return Contact(
        pressure=pressure,
        gap=gap,
        contact=contact,
        depth=depth,
        force=force,
        stiffness=state.stiffness,
        residual=state.residual,
        tolerance=tolerance,
        spacing=indenter.spacing,
        row_spacing=indenter.row_spacing,
        length_unit=indenter.length_unit,
        column_positions=indenter.column_positions,
        row_positions=indenter.row_positions,
    )


def _completeness_warning(indenter: Indenter, contact: Contact) -> str:
    """Return a warning text if all elements are in contact although their heights differ, and "" otherwise."""
    if contact.contact_count < contact.elements or np.ptp(indenter.initial_gap[contact.contact]) == 0:
        return ""
    depth = with_unit(contact.depth, indenter.length_unit)
    text = f"contact is complete, the contact fraction is 1 at the depth u, {depth}; from "
    return text + "there on the stiffness is that of a flat punch, whatever the heights"
