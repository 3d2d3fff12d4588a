"""Tabulate the local exponent β(X) and vt/h at fixed X on grids from coarse to fine, and for an infinitely fine grid.

The estimates are those of viscorough_study.fits.multilevel. X = F/(4GhL) and vt/h contain the rms height h of all waves
of the spectrum, also of those that no grid has. The mean square of the waves on a grid is smaller by the factor
`height_share`, so with the rms height of the grid, as in the paper, X is larger by 1/√share.

The exponent β(X) is the slope of ln(vt/h) in a decade of X. A decade is used on a grid if at least `elements_min`
elements touch at its lower end, in the median. The *judged* decade starts at the smallest X where so many elements
touch on the second finest grid. There β tends to H/(1 + H) if the 95 % interval of the limit lies within the tolerance
of the claim "beta", and β does not rise from the next decade to this one. It departs if the interval lies outside.
Otherwise, or if the limit cannot be determined, the result is undecided. This criterion was fixed before the large run.
"""

from collections import defaultdict

import numpy as np
import pandas as pd

from viscorough.reference import exponent_beta
from viscorough_study.ensembles.flat_punch import punch_stiffness
from viscorough_study.ensembles.nested_grids import wave_variances
from viscorough_study.fits.intervals import UNDEFINED, described, difference, equivalence, interval, three_columns
from viscorough_study.fits.multilevel import Level, estimates, mean_error, optimal_surfaces, slopes_of, starting_grid
from viscorough_study.run.names import PAPER_GRID

QUANTITIES = {"whole": "vt/h", "interface": "vt/h less X/κ_c of the punch"}
FINDINGS = {True: "tends", False: "departs", None: "undecided"}
# Decades of X start at this many X per decade, and vt/h is tabulated at this many; both divide nested_grids.PER_DECADE.
STARTS, VALUES = 10, 4
HALF_WIDTH = 0.02  # half-width of the 95 % interval of β for which surfaces are allocated
_ROUNDING = 1e-9

_LABELS = {
    "hurst": ("Hurst exponent", "1"),
    "quantity": ("; ".join(f"{name}: {text}" for name, text in QUANTITIES.items()), ""),
}
_ESTIMATE = {
    "across": ("elements across the discs on the grid", "1"),
    "touching": ("median of the elements in contact on the grid, at x or x_low", "1"),
    "base": ("elements across on the grid where the sum over pairs starts; plain average if equal to across", "1"),
}
EXPONENTS = {
    **_LABELS,
    "x_low": ("X at which the decade starts, with h over all waves of the spectrum", "1"),
    **_ESTIMATE,
    "finest": ("1 for the finest grid whose curves reach the end of the decade, else 0", "1"),
    **described("beta", "exponent β in the decade, on this grid"),
    **described("ratio", "ratio of successive differences of β between grids"),
    **described("remainder", "sum of all differences of β beyond the finest grid"),
    **described("limit", "β for an infinitely fine grid; empty if the interval of the ratio reaches 1"),
    "expected": ("H/(1 + H), Eq. 10", "1"),
    "judged": ("1 for the decade of the smallest X, by which the limit is judged, else 0", "1"),
    **described("rise", "β in the judged decade less β in the next decade that the grids support"),
    "finding": ("; ".join(FINDINGS.values()) + ": whether β tends to H/(1 + H), in the judged decade", ""),
}
VELOCITIES = {
    **_LABELS,
    "x": ("X, with h over all waves of the spectrum", "1"),
    **_ESTIMATE,
    "height_share": ("mean square height of the waves on the grid of the paper, over that of all waves", "1"),
    **described("velocity", "the quantity at X on the finest grid, geometric mean over the discs"),
    **described("limit", "the quantity for an infinitely fine grid; empty if the differences need not converge"),
    "error": ("standard error of the mean logarithm of the quantity on the finest grid", "1"),
    "deviation": ("standard deviation of the logarithm of the quantity between discs, on the finest grid", "1"),
    "processor_s": ("processor time of a disc on the finest grid", "s"),
    "sum_s": ("processor time of all discs of the sum", "s"),
}
COSTS = {
    "hurst": _LABELS["hurst"],
    "x_low": EXPONENTS["x_low"],
    "across": _ESTIMATE["across"],
    "coarser": ("elements across on the next coarser grid; empty on the first", "1"),
    "base": _ESTIMATE["base"],
    "surfaces": ("discs on this grid", "1"),
    "deviation": ("standard deviation of β between discs, on the first grid of the sum; of the difference beyond", "1"),
    "processor_s": ("processor time of a disc on the first grid of the sum, and of a pair of grids beyond", "s"),
    "optimal": (f"discs that give β on the finest grid ± {HALF_WIDTH:g} at the least processor time", "1"),
    "half_width": ("half-width of the 95 % interval of β on the finest grid", "1"),
    "sum_s": ("processor time of all discs of the sum", "s"),
    "plain_s": ("processor time of plain averaging on the finest grid for the same interval", "s"),
    "cost_ratio": ("sum_s over plain_s; 1 for plain averaging", "1"),
}


def fine_grids(contents, *, elements_min, tolerance, seed):
    """Return three tables: {"fine_exponents": table, "fine_velocities": table, "fine_costs": table}.

    Their columns are `EXPONENTS`, `VELOCITIES` and `COSTS`.

    contents : Contents from ensembles.nested_grids.nested_curves, one for each Hurst exponent and grid
    elements_min : smallest median of the elements in contact at the lower end of a decade
    tolerance : tolerance of the claim `beta`
    seed : seed of the draws for the intervals of limits
    """
    by_hurst = defaultdict(list)
    for content in contents:
        by_hurst[float(content.variables["hurst"].values)].append(_Curves(content))
    tables = {"fine_exponents": [], "fine_velocities": [], "fine_costs": []}
    for hurst, grids in sorted(by_hurst.items()):
        grids.sort(key=lambda curves: curves.across)
        judged = judged_decade(grids, elements_min)
        for quantity in QUANTITIES:
            labels = {"hurst": hurst, "quantity": quantity}
            exponents = list(_exponents(grids, quantity, hurst, judged, elements_min, seed))
            _judge(exponents, tolerance)
            velocities = _velocities(grids, quantity, hurst, elements_min, seed)
            tables["fine_exponents"] += [labels | row for row in exponents]
            tables["fine_velocities"] += [labels | row for row in velocities]
        tables["fine_costs"] += [{"hurst": hurst} | row for row in _costs(grids, elements_min)]
    columns = {"fine_exponents": EXPONENTS, "fine_velocities": VELOCITIES, "fine_costs": COSTS}
    return {name: pd.DataFrame(rows, columns=list(columns[name])) for name, rows in tables.items()}


class _Curves:
    """Curves of the same discs on a grid and on the next coarser grid.

    elements : elements across on both grids, or on the coarsest grid alone
    across : elements across on the finer grid
    x : abscissae, shape (abscissae,)
    touching : median of the elements in contact on the grid, shape (abscissae,)
    seconds : mean processor time of a disc on both grids
    """

    def __init__(self, content):
        values = {name: variable.values for name, variable in content.variables.items()}
        self.x, self._logarithms = values["x"], values["log_velocity"]
        self.elements = [int(across) for across in values["elements"]]
        self.across = self.elements[0]
        self.touching = np.median(values["contact_count"][:, 0], axis=0)
        self.seconds = tuple(np.append(values["processor_s"].mean(axis=0), 0.0)[:2])
        self.surfaces = len(self._logarithms)

    def level(self, quantity, matrix):
        """Return the `Level` of statistics that are linear in ln(vt/h), or in ln g for the interface.

        matrix : statistics of curves, shape (abscissae, statistics); the curves may be longer
        """
        values = self._logarithms[..., : len(matrix)]
        if quantity == "interface":
            x = self.x[: len(matrix)]
            punches = np.array([punch_stiffness(across) for across in self.elements])
            values = np.log(np.exp(values) - x / punches[:, None])
        statistics = values @ matrix
        coarse = statistics[:, 1] if statistics.shape[1] > 1 else None
        return Level(self.across, statistics[:, 0], coarse, self.seconds)

    def reaches(self, x):
        return self.x[-1] >= x * (1 - _ROUNDING)


def judged_decade(grids, elements_min):
    """Return the X at which the decade of the smallest X starts, by which the limit is judged; nan if there is none.

    grids : curves on grids from coarse to fine
    """
    if len(grids) < 2:
        return np.nan
    second = grids[-2]
    starts = [x for x in _starts(second) if second.touching[_position(second.x, x)] >= elements_min]
    return starts[0] if starts and grids[-1].reaches(10 * starts[0]) else np.nan


def _starts(curves, per_decade=STARTS):
    """Return the abscissae whose decimal logarithms are multiples of 1/per_decade."""
    numbers = per_decade * np.log10(curves.x)
    return curves.x[np.abs(numbers - np.round(numbers)) < 1e-6]


def _position(x, value):
    return int(np.argmin(np.abs(np.log(x / value))))


def _window(x, low):
    return _position(x, low), _position(x, 10 * low)


def _exponents(grids, quantity, hurst, judged, elements_min, seed):
    """Yield the rows of the table of exponents, for every grid and every decade that the grid supports."""
    expected = exponent_beta(hurst)
    for position, finest in enumerate(grids):
        used = grids[: position + 1]
        starts = [
            low
            for low in _starts(finest)
            if finest.reaches(10 * low) and finest.touching[_position(finest.x, low)] >= elements_min
        ]
        if not starts:
            continue
        matrix = slopes_of(np.log(finest.x), [_window(finest.x, low) for low in starts])
        levels = [curves.level(quantity, matrix) for curves in used]
        is_finest = [not any(curves.reaches(10 * low) for curves in grids[position + 1 :]) for low in starts]
        for low, estimate, last in zip(starts, estimates(levels, seed), is_finest, strict=True):
            row = {
                "x_low": low,
                "across": finest.across,
                "touching": finest.touching[_position(finest.x, low)],
                "base": used[estimate.base].across,
                "finest": int(last),
                "expected": expected,
                "judged": int(last and bool(np.isclose(low, judged))),
                "finding": "",
                **three_columns("beta", (estimate.value, estimate.low, estimate.high)),
                **three_columns("rise", UNDEFINED),
            }
            for name in ("ratio", "remainder", "limit"):
                row |= three_columns(name, getattr(estimate, name) if last else UNDEFINED)
            yield row


def _judge(rows, tolerance):
    """Add the finding to the row of the judged decade; rows : rows of a quantity and Hurst exponent."""
    finest = {round(STARTS * np.log10(row["x_low"])): row for row in rows if row["finest"]}
    for start, row in finest.items():
        if row["judged"]:
            later = [after for after in finest if after >= start + STARTS]
            rise = difference(interval(finest[min(later)], "beta"), interval(row, "beta")) if later else UNDEFINED
            row |= three_columns("rise", rise)
            row["finding"] = finding(interval(row, "limit"), rise, row["expected"], tolerance)


def finding(limit, rise, expected, tolerance):
    """Return whether an exponent tends to a law as grids become finer; the result is a value of `FINDINGS`.

    limit, rise : (value, low, high) of the limit, and of β in the judged decade less β in the next decade
    expected : exponent of the law; tolerance : largest deviation allowed
    """
    within = equivalence(limit[1:], expected - tolerance, expected + tolerance)
    return FINDINGS[None if within and not rise[1] <= 0 else within]


def _velocities(grids, quantity, hurst, elements_min, seed):
    """Yield the rows of the table of vt/h at fixed X on the finest grid whose curves reach this X."""
    present, missing = wave_variances(hurst, PAPER_GRID)
    before = 0.0
    for position in range(len(grids) - 1, -1, -1):
        finest = grids[position]
        # Curves on finer grids are shorter. Beyond their end, the next coarser grid is the finest.
        beyond = max((curves.x[-1] for curves in grids[position + 1 :]), default=0.0)
        chosen = [
            x
            for x in _starts(finest, VALUES)
            if x > max(beyond, before) * (1 + _ROUNDING) and finest.touching[_position(finest.x, x)] >= elements_min
        ]
        if not chosen:
            continue
        before = chosen[-1]
        matrix = np.zeros((len(finest.x), len(chosen)))
        matrix[[_position(finest.x, x) for x in chosen], np.arange(len(chosen))] = 1.0
        levels = [curves.level(quantity, matrix) for curves in grids[: position + 1]]
        for i, (x, estimate) in enumerate(zip(chosen, estimates(levels, seed), strict=True)):
            numbers, seconds = _spent(levels[estimate.base :])
            yield {
                "x": x,
                "across": finest.across,
                "touching": finest.touching[_position(finest.x, x)],
                "base": grids[estimate.base].across,
                "height_share": present / (present + missing),
                **three_columns("velocity", np.exp([estimate.value, estimate.low, estimate.high])),
                **three_columns("limit", np.exp(estimate.limit)),
                "error": estimate.error,
                "deviation": levels[-1].fine[:, i].std(ddof=1),
                "processor_s": levels[-1].seconds[0],
                "sum_s": float(numbers @ seconds),
            }


def _spent(levels):
    """Return the numbers of discs of a sum, and processor times of a disc on its first grid and of a pair beyond.

    levels : grids of the sum, from coarse to fine
    """
    numbers = np.array([len(level.fine) for level in levels])
    return numbers, np.array([levels[0].seconds[0]] + [sum(level.seconds) for level in levels[1:]])


def _costs(grids, elements_min):
    """Yield the rows of the table of costs: decades of X, and the grids of the sum for each decade."""
    finest = grids[-1]
    for low in _starts(finest, 2):
        if not finest.reaches(10 * low) or finest.touching[_position(finest.x, low)] < elements_min:
            continue
        matrix = slopes_of(np.log(finest.x), [_window(finest.x, low)])
        levels = [curves.level("whole", matrix) for curves in grids]
        base = starting_grid([level.one(0) for level in levels])
        deviations = [levels[base].fine.std(ddof=1)]
        deviations += [(level.fine - level.coarse).std(ddof=1) for level in levels[base + 1 :]]
        numbers, seconds = _spent(levels[base:])
        optimal = optimal_surfaces(np.square(deviations), seconds, HALF_WIDTH)
        half_width = mean_error([level.one(0) for level in levels], base)[1]
        # Plain averaging on the finest grid, with the same half-width by the normal distribution
        plain = levels[-1].fine.var(ddof=1) / (half_width / 1.96) ** 2 * levels[-1].seconds[0]
        spent = float(numbers @ seconds)
        for i, curves in enumerate(grids[base:]):
            yield {
                "x_low": low,
                "across": curves.across,
                "coarser": curves.elements[1] if i else np.nan,
                "base": grids[base].across,
                "surfaces": numbers[i],
                "deviation": deviations[i],
                "processor_s": seconds[i],
                "optimal": optimal[i],
                "half_width": half_width,
                "sum_s": spent,
                "plain_s": plain,
                "cost_ratio": spent / plain,
            }
