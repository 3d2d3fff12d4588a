"""Iterate for the pressure of a contact on a grid by preconditioned conjugate gradients on a shrinking contact set.

`solve_pressure` is the iteration. Elements under tension leave the contact set, and elements that overlap the surface
join it. The half-space operator computes the deflection K d by a search direction d on the whole grid, so the gap is
known everywhere at no further cost. There are two kinds of step:

1. Release step: the length of the step along d is fixed in advance, and elements that the step puts under tension
   leave the set. The operator is then applied once, to the whole change of pressure by the step and by the removal of
   elements.
2. Conjugate step: the step has the length that minimises the energy along d, and no element leaves. This is a step of
   the method of conjugate gradients.

A release step is taken if it would put any element under tension, otherwise a conjugate step. After both kinds of step,
the next direction is conjugate to the last change of pressure. If the bound on the rounding error nears the tolerance,
the gap is recomputed from the pressure. If possible, a release step does this, because it applies the operator anyway.

If a force is given, the depth is adjusted while the pressures are iterated. With the preconditioner M ≈ K⁻¹, a step of
length 1 changes the pressures to P − M e. If the depth also grows by Δu, the product Δu M 1, with a vector 1 of ones,
is added to these pressures. Before every step Δu is chosen so that the pressures after the step sum to the force. The
residual and the depth then converge together, and a contact at a given force takes few more iterations than a contact
at a given depth.

The functions from `begin_search` to `conjugate_step` are the parts of conjugate gradients on a fixed contact set.
Module tangent uses them, too, for the tangent q and its residual e_q instead of the pressure P and the gap e.

Symbols are defined in contact.state. M is the preconditioner.
"""

from collections.abc import Iterator
from functools import lru_cache, partial

import numpy as np

from viscorough.basics.types import Array, Integers
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import joined
from viscorough.contact.grid.state import GridWorkspace, PressureState, Search, TrialContact
from viscorough.contact.halfspace.influence import influence_coefficient
from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.contact.state import ContactSet, TargetForce

# Elements without pressure that the first step would put under tension do not belong in the contact set. If they are
# more than this share of the set, they are removed before the step, because the preconditioned residual on a far too
# large set gives a poor search direction.
_EXCLUDED = 0.05
# Share of the largest allowed residual. If the bound on the rounding error of the gap exceeds this share, and further
# steps add less than this share, the gap is recomputed from the pressure in a release step. The step then needs no
# other application of the operator.
_INEXACT = 0.25
# Length of the second and all later release steps of a contact. It is about the inverse of the mean eigenvalue of M K,
# with the preconditioner M. The first release step has length 1, because the contact set is still too large, so the
# residual overestimates the change of pressure.
_LATER_STEPS = 1.1
# The length of release steps is halved each time this number of release steps has been taken. After the first halving,
# conjugate gradients also start anew after every release step. This is a safeguard against endless cycles with a poor
# preconditioner.
_HALVE_STEP_EVERY = 20
# Largest magnitude of the conjugacy factor after a step that has removed elements from the contact set. The limit is a
# safeguard in case many elements were removed.
_LARGEST_FACTOR = 1.0
# The iteration aims at this share of the tolerance, so that residual and rounding error together stay within the
# tolerance.
_SEARCH_SHARE = 0.999
# If fewer elements than this are in contact, the largest allowed residual is reduced in proportion to their number.
# Otherwise an element could be left out because its overlap is below the tolerance, although it carries a large part of
# the force of such a small contact.
_FEW = 100
# Smallest ratio of the residual to the depth that single precision can reach.
_LEAST_RESIDUAL = 1e-5
# Largest factor by which the depth grows or shrinks in one iteration.
_LARGEST_RATIO = 2.0
# The target force counts as met if the depth is wrong by at most this share of the largest gap |e| that is allowed at
# elements in contact. The remaining error is corrected along the tangent.
_ACCURACY = 0.2
# Reduced stiffness, the sum of q = dP/du, of a single square element in contact. This smallest possible value is used
# until `_prepare_search` computes an estimate for the contact set.
_LEAST_STIFFNESS = 0.28


def solve_pressure(grid: GridWorkspace, trial: TrialContact, target: TargetForce | None = None) -> ContactSet:
    """Solve for the pressures P ≥ 0 of a contact: K P = u − g on the contact set, and no overlap elsewhere.

    The iteration ends when the residual |e| in contact, and the overlap of indenter and surface elsewhere, are below a
    limit that the tolerance of the grid sets.

    grid : GridWorkspace; no other iteration may use it at the same time
    trial : TrialContact, the first guess, which becomes the solution
    target : TargetForce; the depth is adjusted to this force during the iteration. None: the depth is kept

    Returns the ContactSet of the solution.
    Raises ConvergenceError if the iteration takes more than max_iterations steps.
    """
    state = PressureState(
        trial,
        grid.contact_set(trial.inside),
        has_tension=grid.loops.lowest(trial.pressure) < 0,
        ones=np.ones(trial.pressure.size if target else 0, np.float32),
        stiffness=_LEAST_STIFFNESS,
    )
    for iteration in range(grid.options.max_iterations):
        _measure(grid, state)
        if _is_close(grid, state, target):
            if _try_to_finish(grid, state):
                return state.contact_set
            continue
        search = _prepare_search(grid, state, target)
        precondition(grid, search)
        if target:
            _adjust_depth(grid, state, search, target)
        next_direction(grid, search)
        if iteration == 0 and _exclude_unloaded(grid, state, search):
            continue
        length = (_LATER_STEPS if state.releases else 1.0) * 0.5 ** (state.releases // _HALVE_STEP_EVERY)
        state.set_changed = _causes_tension(grid, search, length, trial.pressure)
        recomputes = _can_recompute(grid, state)
        trial.change.rounding += grid.step_rounding * state.largest + grid.field_rounding * trial.depth
        if state.set_changed or recomputes:
            _take_release_step(grid, state, search, length, recomputes)
        else:
            state.has_tension = conjugate_step(grid, search, trial.pressure, trial.change.values)
        _add_penetrating_elements(grid, state)
    raise grid.not_converged(state.contact_set, state.largest, state.limit)


# ---- conjugate gradients on a fixed contact set


def begin_search(grid: GridWorkspace, contact_set: ContactSet) -> Search:
    """Begin conjugate gradients on a contact set.

    The search becomes invalid when the half-space operator is applied to another load.
    """
    direction = grid.halfspace.load.ravel()
    grid.loops.fill(direction, 0)
    grid.preconditioner.prepare(contact_set.inside, contact_set.places.size)
    return Search(contact_set, direction)


def precondition(grid: GridWorkspace, search: Search) -> None:
    """Compute the preconditioned residual z = M e on the contact set; `grid.residual` contains the gap e."""
    search.preconditioned = grid.preconditioner.apply(grid.residual)


def residual_energy(grid: GridWorkspace, search: Search) -> float:
    """Return zᵀe = eᵀ M e, from the gap e and the preconditioned residual z = M e on the contact set.

    The pressure P has the error K⁻¹ e, with the influence matrix K ≈ M⁻¹. The square of this error in the energy norm
    is eᵀ K⁻¹ e, so the result is an estimate of this square. For the tangent, replace e by e_q and P by q.
    """
    return grid.loops.inner_product(search.preconditioned, grid.residual, search.contact_set.places)


def next_direction(grid: GridWorkspace, search: Search) -> None:
    """Replace the search direction d by β d − z, which is conjugate to the last direction.

    β = (z·Kd − d·e)/(d·Kd), with e and z after the last step along d. The term d·e is zero after a step that minimises
    the energy along d. After a release step the term corrects β, on the assumption that the next step has length 1. β
    is 0 if no step along d was taken. After a release step, β is limited to ±_LARGEST_FACTOR.
    """
    factor = 0.0
    if search.deflection is not None:
        by_preconditioned, by_gap, by_direction = _direction_sums(grid, search)
        if by_direction > 0:
            largest = search.largest_factor
            factor = max(-largest, min((by_preconditioned - by_gap) / by_direction, largest))
    _, places, slots = search.contact_set

    def update(i: int, j: int) -> None:
        kernels.update_search_direction(
            direction=search.direction,
            preconditioned=search.preconditioned,
            factor=factor,
            places=places[i:j],
            slots=slots[i:j],
        )

    grid.loops.over(places, update)
    search.deflection, search.released, search.largest_factor = None, np.empty(0, dtype=int), np.inf


def conjugate_step(grid: GridWorkspace, search: Search, pressure: Array, gap: Array) -> bool:
    """Take the step along d that minimises the energy; change pressure and gap in place.

    pressure : P (or the tangent q), flat field
    gap : e − g (or the tangent gap e_q), flat field

    Returns True if any pressure is negative.
    """
    deflection = _deflect(grid, search)
    _, by_gap, by_direction = _direction_sums(grid, search)
    # The length has the precision of the gap, so that the loops compute in this precision. If the first guess was
    # exact, the direction d is zero, and the length of the step is 0.
    length = gap.dtype.type(-by_gap / by_direction if by_direction > 0 else 0.0)
    grid.loops.update_gap(length, deflection, gap)
    _, places, slots = search.contact_set

    def update(i: int, j: int) -> bool:
        return kernels.update_pressure(
            length=length, direction=search.direction, pressure=pressure, places=places[i:j], slots=slots[i:j]
        )

    return any(grid.loops.over(places, update))


def _deflect(grid: GridWorkspace, search: Search) -> Array:
    """Compute the deflection K d, and return it in rows and columns; the next application overwrites the array."""
    deflection = grid.halfspace.apply()
    search.deflection = deflection.ravel()
    return deflection[:, : grid.halfspace.shape[1]]


def _direction_sums(grid: GridWorkspace, search: Search) -> Iterator[float]:
    """Return the inner products z·Kd, d·e and d·Kd over the contact set; `grid.residual` contains e."""
    _, places, slots = search.contact_set

    def sums(i: int, j: int) -> tuple[float, float, float]:
        return kernels.direction_sums(
            direction=search.direction,
            deflection=search.deflection,
            preconditioned=search.preconditioned,
            gap=grid.residual,
            places=places[i:j],
            slots=slots[i:j],
        )

    return map(sum, zip(*grid.loops.over(places, sums), strict=True))


# ---- measuring and finishing


def _measure(grid: GridWorkspace, state: PressureState) -> None:
    """Compute the gap and the largest residual |e| on the current contact set, and the limits of the residual."""
    trial = state.trial
    if state.set_changed:
        state.contact_set = grid.contact_set(trial.inside)
    state.limit = _largest_residual(grid, state)
    places = state.contact_set.places
    state.largest = grid.loops.largest_gap(trial.change.values, grid.initial_gap, grid.residual, places)
    # Residual and rounding error together must not exceed the limit. If the rounding error exceeds half of the limit,
    # `_try_to_finish` recomputes the gap when the residual has fallen to the rounding error.
    state.close_enough = max(state.limit - trial.change.rounding, trial.change.rounding)


def _largest_residual(grid: GridWorkspace, state: PressureState) -> float:
    """Return the largest allowed gap |e| of an element in contact, and overlap of an element out of contact."""
    tolerance, share = grid.tolerance, min(state.contact_set.places.size / _FEW, 1.0)
    return _SEARCH_SHARE * max(share * tolerance, min(tolerance, _LEAST_RESIDUAL)) * state.trial.depth


def _is_close(grid: GridWorkspace, state: PressureState, target: TargetForce | None) -> bool:
    """Return True if the residual is within its limit, no pressure is negative, and a given force is met.

    The force counts as met if a change of the depth by at most _ACCURACY · limit would correct the sum of the
    pressures, or if they sum to less at the largest allowed depth.
    """
    if state.largest > state.close_enough or state.has_tension:
        return False
    if target is None:
        return True
    missing = target.pressure_sum - grid.loops.total(state.trial.pressure, state.contact_set.places)
    return abs(missing) <= _ACCURACY * state.limit * state.stiffness or (
        missing > 0 and state.trial.depth >= target.largest_depth
    )


def _try_to_finish(grid: GridWorkspace, state: PressureState) -> bool:
    """Return True if the contact set is complete and the gap is accurate; otherwise improve set or gap.

    If elements outside the set overlap the surface, add them to the set. If the rounding error of the gap is too
    large, recompute the gap from the pressure.
    """
    trial = state.trial
    state.set_changed = False
    _add_penetrating_elements(grid, state)
    if state.set_changed:
        return False
    if trial.change.rounding <= 0.5 * state.limit:
        return True
    grid.recompute_gap(trial.pressure, trial.depth, trial.change)
    grid.add_penetrating_elements(trial.change, trial.inside, state.limit)
    # The recomputation may have overwritten the search direction, which is kept in the load array of the operator. So
    # conjugate gradients must begin anew.
    state.set_changed, state.search = True, None
    return False


def _add_penetrating_elements(grid: GridWorkspace, state: PressureState) -> None:
    """Add elements to the contact set that overlap the surface by more than the residual may be."""
    if grid.add_penetrating_elements(state.trial.change, state.trial.inside, state.close_enough):
        state.set_changed = True


# ---- steps that change the contact set


def _prepare_search(grid: GridWorkspace, state: PressureState, target: TargetForce | None) -> Search:
    """Return the search, on the current contact set: begin it, or continue the last search on a changed set.

    On another set, the last direction is set to zero on removed elements. It is already zero on new elements. If a
    force is given, the tangents q = dP/du of a new set and their sum are estimated with the preconditioner, as M 1.
    """
    search = state.search
    if search is not None and not state.set_changed:
        return search
    if search is None or not 0 < state.releases < _HALVE_STEP_EVERY:
        search = begin_search(grid, state.contact_set)
    else:
        search.direction[search.released] = 0
        search.contact_set = state.contact_set
        grid.preconditioner.prepare(state.contact_set.inside, state.contact_set.places.size)
    if target:
        state.response = grid.preconditioner.apply(state.ones)[state.contact_set.places]
        state.stiffness = float(state.response.sum(dtype=float))
    state.search = search
    return search


def _exclude_unloaded(grid: GridWorkspace, state: PressureState, search: Search) -> bool:
    """Remove elements without pressure from the contact set if a step along d would put many of them under tension.

    Returns True if elements were removed.
    """
    _, places, slots = state.contact_set

    def find(i: int, j: int) -> Integers:
        found = np.empty(j - i, places.dtype)
        count = kernels.unloaded_under_tension(
            direction=search.direction,
            pressure=state.trial.pressure,
            places=places[i:j],
            slots=slots[i:j],
            found=found,
        )
        return found[:count]

    excluded = joined(grid.loops.over(places, find))
    if excluded.size <= _EXCLUDED * places.size:
        return False
    state.trial.inside[excluded] = False
    state.set_changed = True
    return True


def _causes_tension(grid: GridWorkspace, search: Search, length: float, pressure: Array) -> bool:
    """Return True if a step of the given length along d would put any element under tension."""
    _, places, slots = search.contact_set

    def causes_tension(i: int, j: int) -> bool:
        return kernels.step_causes_tension(
            length=length, direction=search.direction, pressure=pressure, places=places[i:j], slots=slots[i:j]
        )

    return any(grid.loops.over(places, causes_tension))


def _can_recompute(grid: GridWorkspace, state: PressureState) -> bool:
    """Return True if the rounding error of the gap is too large, and recomputing the gap is worthwhile now.

    It is worthwhile if later steps add so little rounding error that the gap need not be recomputed again.
    """
    change = state.trial.change
    too_large = max(_INEXACT * state.limit, 2 * (grid.exact_rounding + grid.field_rounding) * state.trial.depth)
    return change.rounding > too_large and grid.step_rounding * state.largest < _INEXACT * state.limit


def _take_release_step(
    grid: GridWorkspace, state: PressureState, search: Search, length: float, recomputes: bool
) -> None:
    """Take a step of given length along d, remove elements under tension from the contact set, and update the gap.

    Neighbours of a removed element take over parts of its load (see `kernels.release`). The direction then holds the
    total change of pressure.

    length : factor of d in the change of pressure
    recomputes : True if the gap is recomputed from the pressure; False if the deflection by the step is added to it
    """
    trial, (inside, places, slots) = state.trial, state.contact_set

    def step(i: int, j: int) -> Integers:
        found = np.empty(j - i, np.int64)
        count = kernels.step_and_find_tension(
            length=length,
            direction=search.direction,
            pressure=trial.pressure,
            inside=inside,
            places=places[i:j],
            slots=slots[i:j],
            first=i,
            released=found,
        )
        return found[:count]

    released = joined(grid.loops.over(places, step))
    # An element that leaves changes the loads of its neighbours, so two threads must not release elements close to each
    # other. Divide the rows of the grid into bands of at least two rows. A single thread processes a band. All even
    # bands are processed at the same time, then all odd bands: no element has neighbours in two even bands or in two
    # odd bands.
    band = max(BLOCK // grid.width, 2) * grid.width
    bands = np.split(released, np.searchsorted(places[released], np.arange(band, trial.pressure.size, band)))

    def release(some_bands: list[Integers], first: int, last: int) -> None:
        for members in some_bands[first:last]:
            kernels.release(
                direction=search.direction,
                pressure=trial.pressure,
                inside=inside,
                places=places,
                slots=slots,
                released=members,
                stencil=load_redistribution_stencil(grid.aspect),
                width=grid.width,
                stride=grid.halfspace.load.shape[1],
            )

    for some_bands in filter(None, (bands[::2], bands[1::2])):
        run_blocks(partial(release, some_bands), len(some_bands), grid.loops.threads, 1)
    search.released, search.largest_factor = slots[released], _LARGEST_FACTOR
    state.releases += 1
    state.has_tension = False
    if recomputes:
        grid.recompute_gap(trial.pressure, trial.depth, trial.change)
    else:
        values = trial.change.values
        grid.loops.update_gap(values.dtype.type(1), _deflect(grid, search), values)


@lru_cache(maxsize=4)
def load_redistribution_stencil(aspect: float) -> Array:
    """Return the shares of its load that an element passes to its eight neighbours when it leaves the contact.

    The shares result from eliminating the element from the influence matrix of the 5 × 5 elements around it.

    aspect : dy/dx of the elements

    Returns an array of shape (3, 3). At its centre is −1, because the element loses its whole load.
    """
    row, column = np.divmod(np.arange(25.0), 5)
    inverse = np.linalg.inv(influence_coefficient(row[:, None] - row, column[:, None] - column, aspect))
    return -inverse[12].reshape(5, 5)[1:-1, 1:-1] / inverse[12, 12]


# ---- adjustment of the depth to a given force


def _adjust_depth(grid: GridWorkspace, state: PressureState, search: Search, target: TargetForce) -> None:
    """Change the depth so that the pressures after a step of length 1 sum to the force; update e, z and e − g.

    The change Δu of the depth is subtracted from e and from e − g, and Δu M 1 is subtracted from z.
    """
    trial, places = state.trial, state.contact_set.places
    depth, largest_depth = trial.depth, target.largest_depth
    predicted = grid.loops.total(trial.pressure, places) - grid.loops.total(search.preconditioned, places)
    next_depth = depth + (target.pressure_sum - predicted) / state.stiffness
    next_depth = min(max(next_depth, depth / _LARGEST_RATIO), depth * _LARGEST_RATIO, largest_depth)
    step = trial.change.values.dtype.type(next_depth - depth)
    trial.change.values -= step

    def shift(i: int, j: int) -> None:
        kernels.shift_on_set(
            depth_step=np.float32(step),
            gap=grid.residual,
            preconditioned=search.preconditioned,
            places=places[i:j],
            response=state.response[i:j],
        )

    grid.loops.over(places, shift)
    trial.depth = min(depth + float(step), largest_depth)
    state.limit = _largest_residual(grid, state)
