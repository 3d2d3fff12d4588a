"""Direct integration of growing viscoelastic contact, exact from contact event to contact event.

While the contact set does not change, its elements move with the indenter. In every medium the motions y of the
elements (see the module internal_variables) then satisfy y' = q u', with K q = 1 on the set. So the contact events
depend on the motion only, not on the medium. They are the events that newtonian_events computes for a viscous medium,
if the total motion Z = 4πd Σy of all elements replaces the impulse ∫F dt/η. Let W_i be 4πd times the sum over all
elements of the internal variable w_i of branch i. The force is

    F = G∞ Z + Σ_i G_i W_i + η Z',    W_i' = Z' − W_i/τ_i.

This linear system with constant coefficients has modes r_j, which decay independently while the force is constant:

    Z' = J₀ F' + φ F + Σ_j κ_j r_j,    r_j' = F' − λ_j r_j.

With a parallel dashpot η there is one mode, r = η Z', with λ = G∞/η and κ = 1/η. Without a dashpot, the modes are found
in four steps:

1. Count the relaxed spring G∞ as a branch with the rate 0, and let G₀ be the sum of all moduli.
2. Let s be the unit vector with the components √(G_i/G₀), and R the diagonal matrix of the rates 1/τ_i. The forces in
   the branches, each divided by √G_i, are a vector with the component F/√G₀ along s. Its components perpendicular to s
   relax independently of F.
3. Choose an orthonormal basis B of the space perpendicular to s, and find the singular value decomposition
   √R B = U Σ Vᵀ. One-sided Jacobi rotations find it to rounding, even for relaxation times that are many decades apart.
   Matrix exponentials would be less accurate.
4. The rates of the modes are λ_j = Σ_j², and κ_j = (U_j · √R s)²/G₀.

This module uses neither the correspondence with the elastic problem nor the creep
compliance of the medium, so that it is an independent check of both.
"""

from typing import NamedTuple

import numpy as np
from scipy.linalg import lapack
from scipy.special import exprel, hyp1f1

from viscorough.basics.arrays import jumps_and_slopes
from viscorough.viscous.integration.events import newtonian_events


def growing_contact(indenter, medium, times, force, until_fraction):
    """Return the depth and the number of elements in contact at each time, if the contact only grows.

    medium : medium of springs and dashpots
    times, force : samples of the force, in consistent units
    until_fraction : contact fraction that is not exceeded
    """
    motion = _total_motion(_modes(medium.relaxation), np.asarray(times), np.asarray(force))
    events = newtonian_events(indenter, until_fraction=until_fraction)
    assert (np.diff(motion) >= 0).all()
    assert motion[-1] <= events.impulse[-1]
    return events.depth_at(motion), np.where(motion > 0, events.contact_count[events.event_at(motion)], 0)


class _Modes(NamedTuple):
    """Coefficients of the equations of motion Z' = J₀ F' + φ F + Σ κ_j r_j, with modes r_j' = F' − λ_j r_j.

    Z is the total motion of the elements under the force F (see the module docstring).

    instantaneous_compliance : J₀
    fluidity : φ
    weights, rates : coefficients κ_j and decay rates λ_j of the modes, shape (modes,)
    """

    instantaneous_compliance: float
    fluidity: float
    weights: np.ndarray
    rates: np.ndarray


def _modes(relaxation):
    """Return the coefficients of the equations of motion of a medium.

    The medium has either a parallel dashpot or Maxwell branches, and may have a parallel spring.
    """
    viscosity, relaxed, moduli, times = relaxation
    if viscosity:
        return _Modes(0.0, 0.0, np.array([1 / viscosity]), np.array([relaxed / viscosity]))
    fluidity = 0.0 if relaxed else float(1 / (moduli @ times))
    if relaxed:
        moduli, rates = np.append(relaxed, moduli), np.append(0.0, 1 / times)
    else:
        rates = 1 / times
    total = moduli.sum()
    unit = np.sqrt(moduli / total)
    # The Householder reflection turns the unit vector to the first axis. So all columns of its matrix, except the
    # first, are perpendicular to the unit vector.
    mirror = unit + (np.arange(unit.size) == 0)
    basis = (np.eye(unit.size) - np.outer(mirror, mirror) / mirror[0])[:, 1:]
    if not basis.size:
        return _Modes(1 / total, fluidity, np.array([]), np.array([]))
    order = np.argsort(-rates)
    scaled = np.sqrt(rates)[order]
    singular, left, _, scale, _, info = lapack.dgejsv(scaled[:, None] * basis[order], joba=2, jobu=0, jobv=0)
    assert info == 0
    singular = singular * (scale[0] / scale[1])
    weights = (left[:, : singular.size].T @ (scaled * unit[order])) ** 2 / total
    return _Modes(1 / total, fluidity, weights, singular**2)


def _total_motion(modes, times, force):
    """Return the total motion Z at the samples of a force that is linear between them, shape (times,)."""
    instantaneous, fluidity, weights, rates = modes
    jumps, slopes = jumps_and_slopes(times, force)
    motion, state = np.empty(times.size), np.full(rates.size, force[0])
    motion[0] = instantaneous * force[0]
    for k, (length, slope) in enumerate(zip(np.diff(times), slopes, strict=True)):
        x = rates * length
        gain = length * exprel(-x)  # ∫exp(−λt) dt from 0 to length
        # The next line computes ∫(1 − exp(−λt))/λ dt from 0 to length, without cancellation for small x and without
        # overflow for large x, where x = λ length.
        with np.errstate(divide="ignore", invalid="ignore"):
            gains = np.where(x > 1, (length - gain) / rates, 0.5 * length**2 * hyp1f1(1, 3, -np.minimum(x, 1)))
        at_once = instantaneous * (force[k + 1] - force[k])
        flow = fluidity * length * 0.5 * (force[k] + force[k + 1])
        motion[k + 1] = motion[k] + at_once + flow + weights @ (state * gain + slope * gains)
        state = state * np.exp(-x) + slope * gain + jumps[k + 1]
    return motion
