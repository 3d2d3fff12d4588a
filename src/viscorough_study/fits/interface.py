"""Rough interface and flat punch as two springs in series.

At large loads a rough disc acts as a flat punch in series with a compliant interface. Their compliances add, and so do
velocities: vt/h = X/κ_c + g(X), where κ_c is the stiffness κ of the punch on the same grid, and g is the contribution
of the interface. Where F is exponential in the mean separation, F ∝ exp(−s/u₀), the stiffness of the interface is F/u₀
(Persson, Physical Review Letters 99, 125502 (2007)), and g = u₀/h is constant. u₀/h is therefore taken where g is flat:
the **plateau** is the range of X around the largest g in which g is at most a given fraction below it, and u₀/h is the
mean of g over ln X on it. Lines of the MDR have κ_c = 1.
"""

import numpy as np
import pandas as pd

from viscorough_study.ensembles.flat_punch import grid_and_punch
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.conventions import FITTED
from viscorough_study.fits.intervals import described, described_ends, percentile_interval, three_columns, with_interval
from viscorough_study.fits.power_law import log_means

ENSEMBLE = {
    "source": ("discs (boundary elements) or lines (method of dimensionality reduction)", ""),
    "case_group": ("base, sizes: grids from coarse to fine, or lines", ""),
    "hurst": ("Hurst exponent H", "1"),
    "across": ("elements across the disc, or points of the line", "1"),
    "average": ("mean over the realizations at fixed X", ""),
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
    "velocity": ("mean vt/h", "1"),
    **described("interface", "g: vt/h less X/κ_c of the punch"),
}


def group_ensembles(pool, source, case_group, rms_convention, hursts=None):
    """List of (columns of `ENSEMBLE` except the average, ensemble, κ_c) for every Hurst exponent and grid of a group.

    pool : of viscorough_study.ensembles.pool; hursts : Hurst exponents to select, None for all
    """
    result, pool = [], select(pool, group=case_group)
    if hursts is not None:
        pool = pool.isel(realization=np.flatnonzero(np.isin(pool["hurst"], list(hursts))))
    for (hurst, elements), ensemble in ensembles(pool, "hurst", "elements", rms_convention=rms_convention).items():
        number, punch = grid_and_punch(source, elements)
        labels = {"source": source, "case_group": case_group, "hurst": hurst, "across": number}
        result.append((labels, ensemble, punch))
    return result


def interface_tables(discs, lines, size_discs, size_lines, *, fit, rms_convention):
    """{"interface", "interface_curves": table} of discs and lines, lines at the Hurst exponents of the discs.

    discs, lines, size_discs, size_lines : pools, the last two of grids from coarse to fine
    fit : further arguments of `fit_interface`; rms_convention : of the discs
    """
    cases = group_ensembles(discs, "discs", "base", rms_convention)
    cases += group_ensembles(size_discs, "discs", "sizes", rms_convention)
    hursts = {labels["hurst"] for labels, _, _ in cases}
    cases += group_ensembles(lines, "lines", "lines", "line", hursts)
    cases += group_ensembles(size_lines, "lines", "sizes", "line")
    return dict(zip(("interface", "interface_curves"), fit_interfaces(cases, **fit), strict=True))


def fit_interfaces(cases, **options):
    """Tables with the columns of `COLUMNS` and `CURVES` (pandas.DataFrame), of every ensemble and average.

    cases : as of `group_ensembles`; options : further arguments of `fit_interface`
    """
    rows, curves = [], []
    for labels, ensemble, punch in cases:
        for average in FITTED["average"]:
            row, curve = fit_interface(ensemble, punch, average=average, **options)
            named = labels | {"average": average}
            rows.append(named | row)
            curves.append(curve.assign(**named))
    return (
        pd.DataFrame(rows, columns=list(COLUMNS)),
        pd.concat(curves)[list(CURVES)] if curves else pd.DataFrame(columns=list(CURVES)),
    )


def fit_interface(ensemble, punch, *, plateau, fraction_min, average, resamples, seed):
    """Interface of one ensemble in one rms convention: columns of `COLUMNS`, table of `CURVES`.

    punch : κ_c; plateau : fraction by which g is below its maximum at the ends of the plateau
    fraction_min : smallest fraction of defined realizations for which a mean is taken
    average, resamples, seed : of the mean and its bootstrap, as in viscorough_study.fits.power_law.fit_power_law
    Abscissae at which one element is in contact, region (a), are omitted.
    """
    x, count = ensemble["x"].values, ensemble["contact_count_median"].values
    kept = (ensemble["fraction_defined"].values >= fraction_min) & (count > 1)
    velocity = ensemble["velocity"].values
    samples = np.exp(log_means(velocity, average, resamples, np.random.default_rng(seed)))[:, kept]
    x, size = x[kept], len(velocity)
    interface, interval = samples - x / punch, percentile_interval(samples[1:], size)
    row = {"realizations": size, "kappa_c": punch} | _plateau(x, interface, plateau, size)
    curves = {"x": x, "velocity": samples[0], "interface": interface[0]}
    curves |= {f"interface_{end}": values - x / punch for end, values in zip(("low", "high"), interval, strict=True)}
    return row, pd.DataFrame(curves)


def _plateau(x, interface, plateau, size):
    """Columns of u₀; interface : g of the ensemble and of its resamples, shape (resamples + 1, abscissae)."""
    run = run_around(interface[0] >= (1 - plateau) * interface[0].max(), int(np.argmax(interface[0])))
    u0 = with_interval(interface[:, run].mean(axis=1), size)
    return three_columns("u0", u0) | {"plateau_low": x[run][0], "plateau_high": x[run][-1]}


def run_around(allowed, place):
    """Indices of the run of allowed abscissae that contains `place`, which is allowed."""
    outside = np.flatnonzero(~allowed)
    first = outside[outside < place].max(initial=-1) + 1
    last = outside[outside > place].min(initial=len(allowed))
    return np.arange(first, last)
