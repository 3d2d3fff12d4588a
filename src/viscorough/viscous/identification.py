"""Identification of the medium of a half-space from a measured indentation by a body with a known loading curve.

The record is a measured depth under a known force, or a measured force at a known depth. This module checks the record
and chooses its class (viscous.fit.records). viscous.fit.report fits the medium.
"""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import fdtri

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.arrays import increasing
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Array
from viscorough.media.identified_medium import IdentifiedMedium
from viscorough.media.load import Load, force_load
from viscorough.results.loading_curve import LoadingCurve, check_curve
from viscorough.viscous.fit.records import DepthRecord, ForceRecord, RecedingRecord, Record, Shift
from viscorough.viscous.fit.report import RecordFit, fit_record

KINDS = ("table", "prony", "springpot")
# A measured depth counts as decreasing if the mean of a few neighbouring measurements (rows of the record) lies below
# an earlier mean by more than 3 + √(2 ln n) standard deviations of the difference, where n is the number of means. A
# standard deviation that is estimated from the record is multiplied by 1 + 13/(rows - 4), because few rows do not
# determine it well. Among records that consist of noise without creep, about one in ten thousand exceeds this limit.
_LARGEST_DROP, _LARGER_FOR_FEW_ROWS = 3.0, 13.0
# Rounding error of a measured depth, as a share of the largest depth.
_ROUNDING = 1e-9
# The curve before its first computed point is taken to be straight if the depth of this point is at most this share of
# the largest depth.
_FIRST_LEVEL = 1e-3
# A misfit above a limit gives a warning. If the scatter is known, random errors alone stay below the limit with the
# probability _SIGNIFICANT. If it is not known, the limit is the share _SMALL_MISFIT of the largest value.
_SIGNIFICANT, _SMALL_MISFIT = 0.999, 1e-3
# Largest time, load and measured value, and the inverse of the smallest: products of two of them have finite squares.
_LARGEST_SIZE = 1e60
# If the scatter of the depth is not known, the zero of the depth is assumed to be wrong by this share of the largest
# depth.
_ASSUMED_OFFSET = 1e-3


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
        Loading curve of the indenter. It must reach the largest depth of the record.
    load : array_like or Load
        Prescribed force or depth, which is taken to be free of errors: a constant force that is applied at time 0,
        samples of the force at `times`, or a Load of a force or of a depth. The load may hold and unload, as in creep
        tests, relaxation tests, and force curves.
    times, measured : array_like
        Times and measured values of the record, shape (rows,). Times increase. The values are depths if the load is a
        force, and forces if the load is a depth. Their errors are assumed to be independent from row to row and of the
        same size in all rows.
    kind : str, optional
        Kind of medium that is fitted by least squares: "table" for a medium of free form (a FreeForm, which is written
        as a creep table), "prony", or "springpot".
    scatter : float or str, optional
        Standard deviation of the measured depth [length] or force; a number, or a text such as "2 nm". State it if it
        is known from the instrument. By default it is estimated from the record. A short or very precise record does
        not determine it, and the result then has no intervals.
    fit_offset, fit_drift : bool, optional
        Whether to fit a constant error of the depth (offset), and an error that is linear in time (drift). Fit the
        offset if the point of first contact is not known, and the drift if the instrument drifts. The intervals become
        wider, because offset and drift resemble creep. For a sphere, an offset of 2 % of the last depth changes J by
        3 % at the last time. The change is larger at smaller depths and for rough indenters.

    Returns
    -------
    IdentifiedMedium
        Identified medium, in Pa and s if the curve's unit of length is known, with confidence intervals. The interval
        at a time contains a value if the best medium of springs and dashpots with this value is not significantly
        worse than the best medium of all (profile likelihood, 95 %). Between two times, J does not lie below the
        straight line between the values of `low`.

    Raises
    ------
    ValueError
        If the record has fewer than five rows or leaves the curve. If the depth decreases by more than the scatter
        explains although the force does not decrease. If the record does not determine a medium of this kind, and if
        the scatter is not above 0.

    Warns
    -----
    AccuracyWarning
        If the misfit (rms) of a Prony series or a springpot is larger than the scatter explains. If the scatter is not
        known, the limit is 0.1 % of the largest value.

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
    for name, chosen in (("fit_offset", fit_offset), ("fit_drift", fit_drift)):
        if not isinstance(chosen, bool | np.bool_):
            raise ValueError(f"{name}: {chosen!r:.60}; allowed: True or False")
    unit, shift = curve.length_unit, Shift(offset=fit_offset, drift=fit_drift)
    by_depth = isinstance(load, Load) and load.by_depth
    value_unit = "N" if by_depth else unit
    scatter = _checked_scatter(scatter, value_unit, unit)
    times, measured = _checked_record(curve, times, measured, value_unit)
    prescribed = load if isinstance(load, Load) and load.by_depth else force_load(load, times, unit)
    # Like prescribed forces (Load.in_units_of), measured forces in N are divided by this area in m².
    area = units.square_metres(unit) if by_depth else 1.0
    scatter = None if scatter is None else scatter / area
    record = _record(curve, prescribed, times, measured / area, scatter, shift)
    fit = fit_record(record, kind, scatter)
    if kind != "table":
        _check_misfit(fit, record.measured, area)
    assumed, effect = (np.nan, np.nan) if fit_offset else _effect_of_offset(curve, record, fit, shift)
    return _result(fit, shift, assumed, effect, unit, area)


def _record(
    curve: LoadingCurve, load: Load, times: Array, measured: Array, scatter: float | None, shift: Shift
) -> Record:
    """Return the measured values as a Record of the class that suits them.

    load : prescribed force or depth, in consistent units
    times, measured, scatter : times, measured values and their standard deviation (None if it is not known)
    shift : whether an offset and a drift of the depth are fitted, too

    Raises ValueError if the curve does not contain all depths. Also raises it if the measured depth decreases, unless
    the force decreases or a drift is fitted.
    """
    load, place = load.with_times(times)
    lags = times - load.time[0]
    for name, values in (("time", lags), ("depth" if load.by_depth else "force", load.values), ("value", measured)):
        size = np.abs(values).max()
        if size > 0 and not 1 / _LARGEST_SIZE <= size <= _LARGEST_SIZE:
            text = f"allowed: from {1 / _LARGEST_SIZE:g} to {_LARGEST_SIZE:g}; check the units"
            raise ValueError(f"record: a largest {name} of {size:.3g}, whose square leaves double precision; {text}")
    if not (load.values if load.by_depth else measured).max() > 0:
        quantity = "force, because no depth is above 0" if load.by_depth else "depth above 0"
        raise ValueError(f"record: no {quantity}; allowed: records that show how the medium creeps or relaxes")
    arguments = curve, load, place, measured, shift
    if load.by_depth:
        _check_within(curve, load.time, load.values)
        _check_first_level(curve, times, load.values[place])
        return ForceRecord(*arguments)
    _check_within(curve, times, measured)
    _check_first_level(curve, times, measured)
    decrease = _decrease(times, measured, scatter or 0.0)
    if decrease is None:
        return DepthRecord(*arguments)
    if (np.diff(load.values[: place[-1] + 1]) < 0).any():
        return RecedingRecord(*arguments)
    if shift.drift:
        return DepthRecord(*arguments)
    raise ValueError(f"record: {decrease}; allowed: depths that grow, unless the force decreases or a drift is fitted")


def _effect_of_offset(curve: LoadingCurve, record: Record, fit: RecordFit, shift: Shift) -> tuple[float, float]:
    """Return an assumed error of the zero of the depth, and the largest relative change of J that this error causes.

    The assumed error is the scatter of the depth. If the scatter is not known, it is a share of the largest depth. The
    change is infinite if no medium fits the record with this error, as for a scatter above the depth.
    """
    load, measured = record.load, record.measured
    assumed = _ASSUMED_OFFSET * float((load.values if load.by_depth else measured).max())
    if not (load.by_depth or np.isnan(fit.scatter)):
        assumed = fit.scatter
    if load.by_depth:
        load = Load(load.time, depth=load.values - assumed)
    else:
        measured = measured - assumed
    try:
        other = fit_record(type(record)(curve, load, record.place, measured, shift), "table", np.nan)
    except ValueError:
        return assumed, np.inf
    shown = fit.time >= record.first
    return assumed, float(np.abs(other.compliance[shown] / fit.compliance[shown] - 1).max())


def _result(fit: RecordFit, shift: Shift, assumed: float, effect: float, unit: str, area: float) -> IdentifiedMedium:
    """Return the result of a fit as an IdentifiedMedium.

    shift : whether an offset and a drift of the depth were fitted
    assumed, effect : assumed_offset and offset_effect of the IdentifiedMedium
    unit : unit of length
    area : factor that converts scatter and misfit to the unit of the measured values
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
    """Return the scatter as a number in the unit `value_unit`; None if the user did not state it.

    value_unit : unit of the measured values: "N" for forces, the unit of length for depths
    unit : unit of length of the loading curve
    """
    if scatter is None:
        return None
    scatter = units.number(scatter, value_unit, unit, "scatter")
    if not (np.ndim(scatter) == 0 and 0 < scatter < np.inf):
        quantity = "force" if value_unit == "N" else "length"
        raise ValueError(f"scatter: {scatter!r:.60}; allowed: a finite {quantity} above 0, or None to find it")
    return scatter


def _check_misfit(fit: RecordFit, measured: Array, factor: float) -> None:
    """Warn if the misfit of the medium is larger than the scatter explains.

    factor : factor that converts numbers of the fit to the unit of the user's values, for the text of the warning
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
    """Return times and measured values as arrays of floats. Raises ValueError if there are fewer than five rows.

    unit : unit of the measured values
    """
    times = increasing("times", units.numbers(times, "s", curve.length_unit, "times"))
    values = units.numbers(values, unit, curve.length_unit, "measured")
    if values.shape != times.shape or values.size < 5 or not np.isfinite(values).all():
        raise ValueError(
            f"record: {times.size} times, values of shape {values.shape}; allowed: five or more rows of finite numbers"
        )
    return times, values


def _check_within(curve: LoadingCurve, times: Array, depth: Array) -> None:
    """Raise ValueError if a depth of the record lies beyond the end of the loading curve."""
    if depth.max() > curve.depth[-1]:
        where = int(np.argmax(depth > curve.depth[-1]))
        raise ValueError(
            f"record: depth {depth[where]:.6g} at time {times[where]:.6g} is beyond the curve's last level; allowed: "
            f"up to {curve.depth[-1]:.6g}; indent further, with {argument('until_fraction', 1)}"
        )


def _check_first_level(curve: LoadingCurve, times: Array, depth: Array) -> None:
    """Raise ValueError if a depth of the record lies where the loading curve is not known, before its first point.

    Between depth zero and its first computed point (level), a curve is known only if it is straight. It is also taken
    to be straight if the depth of the first point is a tiny share of the largest depth in the record.
    """
    undetermined = np.isnan(curve.at_force(curve.force[0] / 2)[0]) and curve.depth[0] > _FIRST_LEVEL * depth.max()
    if undetermined and (before := (depth < curve.depth[0]) & (depth != 0)).any():
        where = int(np.argmax(before))
        raise ValueError(
            f"record: depth {depth[where]:.6g} at time {times[where]:.6g} is before the curve's first level; allowed: "
            f"from {curve.depth[0]:.6g} on; indent from smaller depths, or leave these rows out"
        )


def _decrease(times: Array, depth: Array, scatter: float) -> str | None:
    """Return a text that states where the depth decreases by more than its errors explain, or None.

    The errors are the scatter and the resolution of the record. The resolution is the smallest difference between
    neighbouring depths that are not equal, and 0 if no neighbouring depths are equal.

    scatter : scatter that the user stated, or 0. If the second differences of the depth show a larger scatter, the
        larger scatter counts
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
        allowed = largest + resolution + _ROUNDING * abs(depth).max()
        if (drop > allowed).any():
            where = int(np.argmax(drop > allowed))
            return (
                f"at time {times[where * size]:.6g} the depth has receded by {drop[where]:.3g}, more than its scatter, "
                f"{max(scatter, found):.3g}, explains"
            )
    return None
