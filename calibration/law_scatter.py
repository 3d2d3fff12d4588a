"""Intervals of single surfaces about the calibrated law, by quantile regression over the Hurst exponent.

At every abscissa X, the ratio of vt/h or u/h of a disc to the law has the quantile exp(a + b H + c H² + d H³). The four
numbers minimise the pinball loss Σ w (q r⁺ + (1 − q) r⁻) of the residuals r of the logarithm, with q = 0.02 or 0.98
(Koenker & Bassett, Econometrica 46, 33 (1978)). Quantiles need no form of the distribution, which is skew. Both grids
have the same weight: the interval covers the differences between surfaces of 129 and of 257 elements across.
"""

import numpy as np
import pandas as pd
from scipy.optimize import linprog
from scipy.sparse import hstack, identity

from viscorough.law.calibrated_law import SCATTER_COLUMNS as COLUMNS
from viscorough.law.calibrated_law import interface_depth, interface_velocity, penetration_law

_POWERS = 4  # of H in a quantile, from 0 on
# Quantiles at the ends of the interval. The quantiles 0.025 and 0.975 of a finite sample contain 94 % of other discs.
ENDS = {"low": 0.02, "high": 0.98}


def law_at(hurst, x):
    """Return vt/h and u/h of the law at X, also outside its range, each of shape (abscissae,)."""
    constants = penetration_law(hurst).constants
    return x + interface_velocity(x, *constants), x + interface_depth(x, *constants)


def calibrated_scatter(samples, x):
    """Return a table with `COLUMNS`: for each H and X the ends of the interval over the law.

    samples : {(hurst, across): g and the interface's part of u/h, shape (discs, 2, abscissae)}; x : abscissae
    """
    hurst, weight = (np.concatenate(parts) for parts in zip(*_hurst_and_weight(samples), strict=True))
    logarithms = np.concatenate([np.log((x + parts) / law_at(at, x)) for (at, _), parts in samples.items()])
    hursts = np.unique(hurst)
    table = pd.DataFrame({"hurst": np.repeat(hursts, x.size), "x": np.tile(x, hursts.size)})
    for i, name in enumerate(("velocity", "depth")):
        for end, probability in ENDS.items():
            ends = [quantile(hurst, column, weight, probability, hursts) for column in logarithms[:, i].T]
            table[f"{name}_{end}"] = np.exp(np.array(ends).T).ravel().round(6)
    return table[list(COLUMNS)]


def quantile(hurst, values, weight, probability, at):
    """Return the quantile of values as a polynomial of third degree in H, at the Hurst exponents `at`.

    hurst, values, weight : shape (discs,)
    """
    powers = np.vander(hurst, _POWERS)
    cost = np.concatenate([np.zeros(_POWERS), probability * weight, (1 - probability) * weight])
    residuals = hstack([powers, identity(len(values)), -identity(len(values))])
    bounds = [(None, None)] * _POWERS + [(0, None)] * (2 * len(values))
    solution = linprog(cost, A_eq=residuals.tocsc(), b_eq=values, bounds=bounds)
    return np.vander(at, _POWERS) @ solution.x[:_POWERS]


def _hurst_and_weight(samples):
    """Yield H and the weight of each disc; the weights of a sample add up to 1."""
    for (hurst, _), parts in samples.items():
        yield np.full(len(parts), hurst), np.full(len(parts), 1 / len(parts))
