"""Stand-in for slippy.core."""

from types import SimpleNamespace

import dense_contact
import numpy as np

import slippy


def elastic_influence_matrix_spatial(comp, span, grid_spacing, shear_mod, v):
    """The elastic constants and the grid that a convolution needs."""
    assert comp == "zz"
    return SimpleNamespace(modulus=2 * shear_mod / (1 - v), side=grid_spacing[0], span=span)


class plan_convolve:
    """Displacement by pressures in a domain of the grid, of which the search of `bccg` needs the constants."""

    def __init__(self, loads, im, domain, circular, fft_im=True):
        assert (slippy.CUDA, slippy.CORES, circular, fft_im) == (False, 1, False, False)
        assert im.span == tuple(2 * n for n in loads.shape)
        self.constants, self.domain = (im.modulus, im.side), domain

    def change_domain(self, domain):
        self.domain = domain

    def full(self, values):
        field = np.zeros(self.domain.shape)
        field[self.domain] = values
        return field


def bccg(f, b, tol, max_it, x0):
    """Pressures p ≥ 0 with f(p) ≥ b, f(p) = b where p > 0; `tol` is that of the pressures. Then whether it failed."""
    assert x0.shape == b.shape == (f.domain.sum(),)
    gap = np.where(f.domain, b.max() - f.full(b), 1e3 * b.max())
    pressure = dense_contact.pressure_at_depth(gap, b.max(), *f.constants)
    return dense_contact.disturbed(pressure, tol * b.max(), *f.constants)[f.domain], False
