"""Stand-in for ContactMechanics.Systems."""

from types import SimpleNamespace

import dense_contact


class NonSmoothContactSystem:
    """Heights of the surface point into the half-space."""

    def __init__(self, substrate, surface):
        assert surface.heights.shape == substrate.nb_grid_pts
        self.substrate, self.surface = substrate, surface

    def dual_minimize_proxy(self, offset, init_force=None, solver="ccg-without-restart", gtol=1e-8, maxiter=1000):
        """The forces that press, as the solution x; `gtol` is a length."""
        print("what the solver writes to standard output")
        assert init_force.shape == self.surface.heights.shape
        side, modulus = self.substrate.side, self.substrate.young
        gap = self.surface.heights.max() - self.surface.heights
        depth = offset + self.surface.heights.max()
        pressure = dense_contact.pressure_at_depth(gap, depth, modulus, side)
        pressure = dense_contact.disturbed(pressure, gtol, modulus, side)
        return SimpleNamespace(x=pressure.ravel() * side**2, nit=7)
