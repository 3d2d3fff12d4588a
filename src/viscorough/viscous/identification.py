"""The medium from a measured indentation of a body with a known loading curve.

A record is the depth under a known force, or the force at a known depth. Three fits cover all of them:

1. `creep_fit`: the depth of a contact that only grows, which shows the creep compliance J.
2. `receding_fit`: the depth of a contact that recedes when the force decreases. It shows J, too.
3. `relaxation_fit`: the force at a depth of any history, which shows the relaxation modulus ψ.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import fdtri

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.arrays import increasing
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Array, Integers
from viscorough.media.identified_medium import IdentifiedMedium
from viscorough.media.load import Load, force_load
from viscorough.results.loading_curve import LoadingCurve, check_curve
from viscorough.viscous.creep_fit import fit_growing_depth
from viscorough.viscous.receding_fit import fit_receding_depth
from viscorough.viscous.record_fit import ROUNDING, RecordFit, Shift
from viscorough.viscous.relaxation_fit import fit_force

KINDS = ("table", "prony", "springpot")
# Standard deviations by which the mean depth of some rows may lie below that of earlier rows: 3 + √(2 ln n) for n
# means, times 1 + 13/(rows - 4), because few rows show their own standard deviation badly. In records of noise alone,
# without creep, about one of ten thousand exceeds them.
_LARGEST_DROP, _LARGER_FOR_FEW_ROWS = 3.0, 13.0
_FIRST_LEVEL = 1e-3  # of the largest depth: up to there the curve may be taken for straight
# A misfit is larger than the scatter if the chance of it is below 1 - this; without known scatter, if it is larger than
# this share of the largest value.
_SIGNIFICANT, _SMALL_MISFIT = 0.999, 1e-3
_ASSUMED_OFFSET = 1e-3  # of the largest depth, where the scatter of the depth is not known


def identify_medium(
    curve: LoadingCurve,
    load: ArrayLike | Load,
    times: ArrayLike,
    measured: ArrayLike,
    *,
    kind: str = "table",
    scatter: float | str | None = None,
    fit_offset: bool = False,
    fit_drift: bool = False,
) -> IdentifiedMedium:
    """Identify the medium of a half-space from a measured indentation by an indenter with the given loading curve.

    Parameters
    ----------
    curve : LoadingCurve
        LoadingCurve of the indenter, to the largest depth of the record.
    load : array_like or Load
        What was prescribed, or measured exactly: the constant force applied at time 0, samples of the force at `times`,
        or a Load of a force or of a depth. It may hold and unload, as in creep, relaxation, and force curves.
    times, measured : array_like
        The record, shape (rows,); times increase. It holds the depth if the load is a force, and the force if the load
        is a depth. Its scatter is taken for independent from row to row and of one size.
    kind : str, optional
        "table": a CreepTable of the J that fits best; "prony" or "springpot": that medium, fitted by least squares.
    scatter : float or str, optional
        Standard deviation of the measured depth [length] or force, or a text as "2 nm". State it if it is known from
        the instrument: short or very precise records do not determine it, and without it there are no intervals then.
    fit_offset, fit_drift : bool, optional
        Fit an error of the zero of the depth, and a drift of the depth that is linear in time. A zero that is off by
        2 % of the last depth changes J of a sphere by 3 % there, and by more at smaller depths and for rough indenters.
        Fit them if the point of first contact is not known, or if the instrument drifts. Intervals then grow, because
        both resemble creep.

    Returns
    -------
    IdentifiedMedium
        Medium in Pa and s if the curve's unit of length is known. The interval at a time holds all values for which the
        best fit with that value is not significantly worse than the best of all (profile likelihood, 95 %). If the
        depth of a growing contact was measured, fits are the concave J and all J that do not decrease; otherwise they
        are springs and dashpots. Between two times J is at least the chord of `low`.

    Raises
    ------
    ValueError
        For a record of fewer than five rows, or that leaves the curve, or whose depth recedes by more than its scatter
        explains although the force does not decrease, for a kind that the record does not determine, and for a scatter
        that is not above 0.

    Warns
    -----
    AccuracyWarning
        If a Prony series or a springpot misses the record by more than the scatter, or by more than 0.1 % of the
        largest value if the scatter is not known (rms).

    Examples
    --------
    >>> import numpy as np
    >>> from viscorough import Load, StandardLinearSolid, identify_medium, indent, kinetics, self_affine_disc
    >>> curve = indent(self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, seed=1))
    >>> times = np.geomspace(0.1, 100, 50)
    >>> creep = kinetics(curve, 5e-6, 1e6, times)
    >>> identified = identify_medium(curve, 5e-6, creep.time, creep.depth)
    >>> print(f"{1e6 * identified.medium.creep_compliance(10.0):.3f}")
    10.000

    Relaxation after a ramp of the depth:

    >>> ramp = Load([0.0, 1.0, 100.0], depth=[0.0, 1e-6, 1e-6])
    >>> relaxation = kinetics(curve, depth=ramp, medium=StandardLinearSolid(4e6, 1e6, 5.0), times=times)
    >>> identified = identify_medium(curve, ramp, relaxation.time, relaxation.force, kind="prony")
    >>> print(f"{identified.medium.relaxation_modulus(20.0) / 1e6:.3f}")
    1.055
    """
    if kind not in KINDS:
        raise ValueError(f"kind {kind!r}; allowed: {', '.join(KINDS)}")
    check_curve("identify_medium", curve)
    unit, shift = curve.length_unit, Shift(offset=fit_offset, drift=fit_drift)
    by_depth = isinstance(load, Load) and load.by_depth
    value_unit = "N" if by_depth else unit
    scatter = _checked_scatter(scatter, value_unit, unit)
    times, measured = _checked_record(curve, times, measured, value_unit)
    prescribed = load if isinstance(load, Load) and load.by_depth else force_load(load, times, unit)
    # Measured forces are divided by this area, as those of a Load are (Load.in_units_of).
    area = units.square_metres(unit) if by_depth else 1.0
    scatter = None if scatter is None else scatter / area
    record = _Record(curve, *prescribed.with_times(times), times, measured / area, scatter, shift)
    _check_depths(record)
    fit = _fitting_function(record)(curve, record.load, record.place, record.measured, kind, record.scatter, shift)
    if kind != "table":
        _check_misfit(fit, record.measured, area)
    assumed, effect = (np.nan, np.nan) if fit_offset else _effect_of_offset(record, fit)
    return _result(fit, shift, assumed, effect, unit, area)


class _Record(NamedTuple):
    """A record in consistent units.

    load : what was prescribed, the force or the depth, with samples at the rows of the record
    place : index of the sample of each row
    measured : the depth if the force was prescribed, else the force, shape (rows,)
    scatter : standard deviation of `measured`; None if it is not stated
    shift : which errors of the zero of depth are fitted
    """

    curve: LoadingCurve
    load: Load
    place: Integers
    times: Array
    measured: Array
    scatter: float | None
    shift: Shift


def _check_depths(record: _Record) -> None:
    """Raise ValueError for depths, prescribed or measured, that the loading curve does not hold."""
    curve, load, times = record.curve, record.load, record.times
    if load.by_depth:
        _check_within(curve, load.time, load.values)
        _check_first_level(curve, times, load.values[record.place])
    else:
        _check_within(curve, times, record.measured)
        _check_first_level(curve, times, record.measured)


def _fitting_function(record: _Record) -> Callable[..., RecordFit]:
    """Return the function that fits a medium to a record of this kind.

    Raises ValueError for a depth that recedes although neither the force decreases nor a drift is fitted.
    """
    load = record.load
    if load.by_depth:
        return fit_force
    decrease = _decrease(record.times, record.measured, record.scatter or 0.0)
    if decrease is None:
        return fit_growing_depth
    if (np.diff(load.values[: record.place[-1] + 1]) < 0).any():
        return fit_receding_depth
    if record.shift.drift:
        return fit_growing_depth
    raise ValueError(f"record: {decrease}; allowed: depths that grow, unless the force decreases or a drift is fitted")


def _effect_of_offset(record: _Record, fit: RecordFit) -> tuple[float, float]:
    """Return an error of the zero of the depth, and the largest relative change of J that it causes.

    The error is the scatter of the depth, or a share of the largest depth if that is not known.
    """
    load, measured = record.load, record.measured
    scatter = np.nan if load.by_depth else fit.scatter
    assumed = _ASSUMED_OFFSET * float((load.values if load.by_depth else measured).max())
    if not np.isnan(scatter):
        assumed = scatter
    if load.by_depth:
        load = Load(load.time, depth=load.values - assumed)
    else:
        measured = measured - assumed
    other = _fitting_function(record)(record.curve, load, record.place, measured, "table", np.nan, record.shift)
    first = record.times[record.times > load.time[0]][0] - load.time[0]
    shown = fit.time >= first
    return assumed, float(np.abs(other.compliance[shown] / fit.compliance[shown] - 1).max())


def _result(fit: RecordFit, shift: Shift, assumed: float, effect: float, unit: str, area: float) -> IdentifiedMedium:
    """Return a fit as an IdentifiedMedium.

    assumed, effect : assumed_offset and offset_effect; area : factor of scatter and misfit
    """
    ends = np.column_stack([fit.shift_low, fit.shift_high])
    unknown = np.nan, np.full(2, np.nan)
    offset, offset_interval = (float(fit.shift[0]), ends[0]) if shift.offset else unknown
    drift, drift_interval = (float(fit.shift[-1]), ends[-1]) if shift.drift else unknown
    return IdentifiedMedium(
        fit.medium, fit.time, fit.compliance, fit.modulus, fit.low, fit.high, fit.scatter * area, fit.misfit * area,
        offset, offset_interval, drift, drift_interval, assumed, effect, unit,
    )  # fmt: skip


def _checked_scatter(scatter: float | str | None, value_unit: str, unit: str) -> float | None:
    """Return a stated scatter as a number in `value_unit`, "N" or the unit of length; None if it is not stated."""
    if scatter is None:
        return None
    scatter = units.number(scatter, value_unit, unit, "scatter")
    if not (np.ndim(scatter) == 0 and 0 < scatter < np.inf):
        quantity = "force" if value_unit == "N" else "length"
        raise ValueError(f"scatter: {scatter!r:.60}; allowed: a finite {quantity} above 0, or None to find it")
    return scatter


def _check_misfit(fit: RecordFit, measured: Array, factor: float) -> None:
    """Give an AccuracyWarning for a misfit of the medium that is larger than the scatter explains.

    factor : from the numbers of the fit to those of the user
    """
    size, values = np.abs(measured).max(), measured.size
    largest = _SMALL_MISFIT * size
    if not np.isnan(fit.scatter):
        largest = fit.scatter * np.sqrt(fdtri(values, min(fit.freedom, 1e9), _SIGNIFICANT))
    if fit.misfit > largest:
        kind = "depth" if fit.modulus is None else "force"
        text = f"the medium misses the record by {fit.misfit * factor:.3g} (rms), {100 * fit.misfit / size:.2g} % of "
        text += f"the largest {kind}; "
        text += "the scatter is unknown" if np.isnan(fit.scatter) else f"the scatter is {fit.scatter * factor:.3g}"
        warnings.warn(f"{text}: fit another kind, such as a table", AccuracyWarning, stacklevel=3)


def _checked_record(curve: LoadingCurve, times: ArrayLike, values: ArrayLike, unit: str) -> tuple[Array, Array]:
    """Return the record as arrays of floats."""
    times = increasing("times", units.numbers(times, "s", curve.length_unit, "times"))
    values = units.numbers(values, unit, curve.length_unit, "measured")
    if values.shape != times.shape or values.size < 5 or not np.isfinite(values).all():
        raise ValueError(
            f"record: {times.size} times, values of shape {values.shape}; allowed: five or more rows of finite numbers"
        )
    return times, values


def _check_within(curve: LoadingCurve, times: Array, depth: Array) -> None:
    """Raise ValueError for a depth beyond the last level."""
    if depth.max() > curve.depth[-1]:
        where = int(np.argmax(depth > curve.depth[-1]))
        raise ValueError(
            f"record: depth {depth[where]:.6g} at time {times[where]:.6g} is beyond the curve's last level; allowed: "
            f"up to {curve.depth[-1]:.6g}; indent further, with {argument('until_fraction', 1)} or a level "
            f"at that depth ({argument('depths')})"
        )


def _check_first_level(curve: LoadingCurve, times: Array, depth: Array) -> None:
    """Raise ValueError for a row before the curve's first level, unless the curve may be taken for straight there."""
    undetermined = np.isnan(curve.at_force(curve.force[0] / 2)[0]) and curve.depth[0] > _FIRST_LEVEL * depth.max()
    if undetermined and (before := (depth < curve.depth[0]) & (depth != 0)).any():
        where = int(np.argmax(before))
        raise ValueError(
            f"record: depth {depth[where]:.6g} at time {times[where]:.6g} is before the curve's first level; allowed: "
            f"from {curve.depth[0]:.6g} on; indent from smaller depths, or leave these rows out"
        )


def _decrease(times: Array, depth: Array, scatter: float) -> str | None:
    """Return where the depth decreases by more than scatter and resolution of the record explain; None if nowhere.

    scatter : stated scatter of the depth, 0 if none is; the scatter of the second differences counts if it is larger
    """
    steps = np.diff(depth)
    found = 1.4826 * np.median(abs(np.diff(steps))) / np.sqrt(6)
    deviation = max(scatter, found * (1 + _LARGER_FOR_FEW_ROWS / (depth.size - 4)))
    resolution = abs(steps[steps != 0]).min() if 0 < np.count_nonzero(steps) < steps.size else 0.0
    for size in (2**k for k in range(depth.size.bit_length() - 1)):
        count = depth.size // size
        mean = depth[: count * size].reshape(count, size).mean(axis=1)
        drop = np.maximum.accumulate(mean) - mean
        largest = (_LARGEST_DROP + np.sqrt(2 * np.log(count))) * deviation * np.sqrt(2 / size)
        allowed = largest + resolution + ROUNDING * abs(depth).max()
        if (drop > allowed).any():
            where = int(np.argmax(drop > allowed))
            return (
                f"at time {times[where * size]:.6g} the depth has receded by {drop[where]:.3g}, more than its scatter, "
                f"{max(scatter, found):.3g}, explains"
            )
    return None
