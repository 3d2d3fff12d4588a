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
from scipy.optimize import least_squares

from viscorough.calibrated_law import LARGEST_DEVIATION, X_LOW, interface_depth, interface_velocity
from viscorough_study.ensembles.indentation import grid_and_punch
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.conventions import FITTED
from viscorough_study.fits.intervals import described, described_ends, percentile_interval, three_columns, with_interval
from viscorough_study.fits.power_law import log_means

LAW_ELEMENTS_MIN = 5  # smallest median number of elements in contact at which the law is fitted
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
    "exponent": ("exponent b of the law of g: g ∝ X^b at small X", "1"),
    "peak": ("largest g of the law", "1"),
    "peak_x": ("X at which the law of g is largest", "1"),
    "law_low": ("lower end of the range of X in which the law of vt/h holds", "1"),
    "law_high": ("upper end of this range", "1"),
    "deviation": ("largest relative deviation of the law from the mean vt/h in this range", "1"),
    "error": ("largest relative distance of the law from an end of the 95 % interval of the mean vt/h", "1"),
    "depth_offset": ("mean u/h less the integral of the law from X = 0, at law_low", "1"),
    **described_ends("depth", "of the 95 % interval of the offset"),
    "depth_deviation": ("largest relative deviation of the law's depth from the mean u/h in the range of the law", "1"),
}
CURVES = {
    **ENSEMBLE,
    "x": ("X = F/(4GhL) = Ft/(4ηhL)", "1"),
    "velocity": ("mean vt/h", "1"),
    **described("interface", "g: vt/h less X/κ_c of the punch"),
    "law": ("vt/h of the law", "1"),
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
    Abscissae at which one element is in contact, region (a), are omitted. The law describes curves on this grid,
    including the onset of contact: it is fitted at X >= X_LOW with at least `LAW_ELEMENTS_MIN` elements in contact.
    """
    x, count = ensemble["x"].values, ensemble["contact_count_median"].values
    kept = (ensemble["fraction_defined"].values >= fraction_min) & (count > 1)
    velocity = ensemble["velocity"].values
    samples, depths = (
        np.exp(log_means(values, average, resamples, np.random.default_rng(seed)))[:, kept]
        for values in (velocity, _depths(x, velocity))
    )
    x, count, size = x[kept], count[kept], len(velocity)
    interface, interval = samples - x / punch, percentile_interval(samples[1:], size)
    row = {"realizations": size, "kappa_c": punch} | _plateau(x, interface, plateau, size)
    law = fit_law(x, samples[0], punch, (count >= LAW_ELEMENTS_MIN) & (x >= X_LOW))
    row |= _law_columns(x, samples[0], interval, punch, law, depths=depths, size=size)
    curves = {"x": x, "velocity": samples[0], "interface": interface[0]}
    curves |= {f"interface_{end}": values - x / punch for end, values in zip(("low", "high"), interval, strict=True)}
    curves["law"] = x / punch + interface_velocity(x, *law)
    return row, pd.DataFrame(curves)


def _depths(x, velocity):
    """u/h = ∫ vt/h d ln X of every realization at every abscissa; vt/h is proportional to X below the first one."""
    steps = np.diff(np.log(x)) * (velocity[:, 1:] + velocity[:, :-1]) / 2
    return velocity[:, :1] + np.concatenate([np.zeros((len(velocity), 1)), np.cumsum(steps, axis=1)], axis=1)


def _plateau(x, interface, plateau, size):
    """Columns of u₀; interface : g of the ensemble and of its resamples, shape (resamples + 1, abscissae)."""
    run = _run(interface[0] >= (1 - plateau) * interface[0].max(), int(np.argmax(interface[0])))
    u0 = with_interval(interface[:, run].mean(axis=1), size)
    return three_columns("u0", u0) | {"plateau_low": x[run][0], "plateau_high": x[run][-1]}


def fit_law(x, velocity, punch, allowed):
    """(exponent, peak, peak_x) of viscorough.calibrated_law.interface_velocity, by least squares of ln(vt/h).

    velocity : mean vt/h; punch : κ_c; allowed : abscissae of the fit, all of shape (abscissae,)
    All are nan where fewer than four abscissae are allowed.
    """
    if allowed.sum() < 4:
        return (np.nan,) * 3
    x, log_velocity = x[allowed], np.log(velocity[allowed])

    def residuals(logarithms):
        return np.log(x / punch + interface_velocity(x, *np.exp(logarithms))) - log_velocity

    return tuple(np.exp(least_squares(residuals, np.log([0.4, 0.5, 0.8])).x))


def _law_columns(x, velocity, interval, punch, law, *, depths, size):
    """Columns of the law: its constants, its range, its deviations within it, and the offset of its depth."""
    columns = dict(zip(("exponent", "peak", "peak_x"), law, strict=True))
    law_velocity = x / punch + interface_velocity(x, *law)
    deviation = np.abs(law_velocity / velocity - 1)
    holds = (deviation <= LARGEST_DEVIATION) & (x >= X_LOW)
    place = int(np.argmin(np.abs(np.log(x / law[2])))) if np.isfinite(law[0]) else 0
    if not holds[place]:
        return columns
    holds = _run(holds, place)
    offsets = (depths - x / punch - interface_depth(x, *law))[:, holds][:, 0]
    law_depth = x / punch + interface_depth(x, *law) + offsets[0]
    low, high = percentile_interval(offsets[1:], size)
    ends = [np.abs(law_velocity / end - 1)[holds].max() for end in interval]
    columns |= {"law_low": x[holds][0], "law_high": x[holds][-1]}
    columns |= {"deviation": deviation[holds].max(), "error": max(ends)}
    columns |= {"depth_offset": offsets[0], "depth_low": low, "depth_high": high}
    return columns | {"depth_deviation": np.abs(law_depth / depths[0] - 1)[holds].max()}


def _run(allowed, place):
    """Indices of the run of allowed abscissae that contains `place`, which is allowed."""
    outside = np.flatnonzero(~allowed)
    first = outside[outside < place].max(initial=-1) + 1
    last = outside[outside > place].min(initial=len(allowed))
    return np.arange(first, last)
