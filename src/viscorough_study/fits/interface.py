"""Model a rough disc as two springs in series: rough interface and flat punch.

At large loads a rough disc acts as a flat punch in series with a compliant interface. The two compliances add, and so
do the velocities: vt/h = X/κ_c + g(X). Here κ_c is the stiffness κ of the punch on the same grid, and g is the
contribution of the interface. X = F/(4GhL) is the reduced force. Lines of the MDR have κ_c = 1.

If the force decreases exponentially with the mean separation s, F ∝ exp(−s/u₀), then the stiffness of the interface is
F/u₀ (Persson, Physical Review Letters 99, 125502 (2007)), and g = u₀/h is constant. u₀/h is therefore computed as the
mean of g over ln X on the **plateau**. The plateau is the range of X around the largest g in which g is below its
maximum by at most a given fraction.
"""

import numpy as np
import pandas as pd
from scipy.ndimage import label

from viscorough_study.ensembles.flat_punch import ensembles_on_grids
from viscorough_study.ensembles.pool import select
from viscorough_study.fits.intervals import described, described_ends, three_columns, with_interval
from viscorough_study.fits.power_law import log_means

ENSEMBLE = {
    "source": ("discs (boundary elements) or lines (method of dimensionality reduction)", ""),
    "hurst": ("Hurst exponent H", "1"),
    "across": ("elements across the disc, or points of the line", "1"),
}
COLUMNS = {
    **ENSEMBLE,
    "realizations": ("realizations", "1"),
    "kappa_c": ("stiffness κ of the flat punch on this grid", "1"),
    **described("u0", "u₀/h: mean of the interface's part g of vt/h over the plateau"),
    **described_ends("plateau", "of the plateau of g in X"),
}
CURVES = {
    **ENSEMBLE,
    "x": ("X = F/(4GhL) = Ft/(4ηhL)", "1"),
    **described("interface", "g: arithmetic mean of vt/h less X/κ_c of the punch"),
}


def interface_tables(discs, law, lines, *, fit):
    """Fit the interface of all discs, and of lines with the same Hurst exponents; return two tables.

    discs, law, lines : pools (viscorough_study.ensembles.pool) of the discs, of which only the group base is used, of
        the discs of further Hurst exponents, and of the lines. h is the rms height of each disc
    fit : further arguments of `fit_interface`
    Returns {"interface": table, "interface_curves": table}, pandas.DataFrames with the columns `COLUMNS` and `CURVES`.
    """
    base = select(discs, group="base")
    hursts = np.concatenate([base["hurst"].values, law["hurst"].values])
    lines = lines.isel(realization=np.flatnonzero(np.isin(lines["hurst"], hursts)))
    rows, curves = [], []
    for source, pool in (("discs", base), ("discs", law), ("lines", lines)):
        for hurst, number, punch, ensemble in ensembles_on_grids(pool, source):
            labels = {"source": source, "hurst": hurst, "across": number}
            row, curve = fit_interface(ensemble, punch, **fit)
            rows.append(labels | row)
            curves.append(curve.assign(**labels))
    curves = pd.concat(curves, ignore_index=True)[list(CURVES)]
    return {"interface": pd.DataFrame(rows, columns=list(COLUMNS)), "interface_curves": curves}


def fit_interface(ensemble, punch, *, plateau, fraction_min, resamples, seed):
    """Fit the interface of one ensemble; return {column of `COLUMNS`: value}, and a table of g(X).

    ensemble : ensemble dataset (ensembles.averages) with a single definition of the rms height
    punch : κ_c of the flat punch
    plateau : g decreases by this fraction from its maximum to the ends of the plateau
    fraction_min : smallest fraction of the realizations that must reach an abscissa
    resamples, seed : number of resamples and seed of the bootstrap

    The mean over the realizations is arithmetic, since compliances add. Abscissae with one element in contact, region
    (a), are omitted. If none remains, the row has no u₀/h and no plateau, and the table of g(X) has no rows.
    """
    x, count, velocity = (ensemble[name].values for name in ("x", "contact_count_median", "velocity"))
    kept = (ensemble["fraction_defined"].values >= fraction_min) & (count > 1)
    samples = np.exp(log_means(velocity, "arithmetic", resamples, np.random.default_rng(seed)))[:, kept]
    x, size = x[kept], len(velocity)
    interface = samples - x / punch
    curve = pd.DataFrame({"x": x} | three_columns("interface", with_interval(interface, size)))
    if not x.size:
        return {"realizations": size, "kappa_c": punch}, curve
    largest = int(np.argmax(interface[0]))
    run = run_around(interface[0] >= (1 - plateau) * interface[0, largest], largest)
    row = {"realizations": size, "kappa_c": punch, "plateau_low": x[run][0], "plateau_high": x[run][-1]}
    row |= three_columns("u0", with_interval(interface[:, run].mean(axis=1), size))
    return row, curve


def run_around(allowed, place):
    """Return the indices of the uninterrupted run of allowed abscissae that contains the index `place`.

    allowed : mask of the abscissae; the abscissa `place` always counts as allowed
    """
    runs, _ = label(allowed | (np.arange(len(allowed)) == place))
    return np.flatnonzero(runs == runs[place])
