"""Tabulate the local exponent β(X) on grids from coarse to fine, and the interval of its limit on finer grids.

The estimates are those of viscorough_study.fits.multilevel. X = F/(4GhL) and vt/h contain the rms height h of all waves
of the spectrum, also of those that no grid has. Two quantities are evaluated: vt/h, and the part of the interface,
g = vt/h − X/κ_c, where κ_c is the stiffness of the flat punch on the grid. β is the slope of a straight line through
the logarithm of the quantity over a decade of ln X. It is linear in the logarithm, so a mean over discs of β is β of
their geometric mean.

A decade of X is used on a grid if at least `elements_min` elements touch at its lower end, in the median. All coarser
grids enter the estimate whatever their number of elements. The interval of the limit needs at least `LAST_ELEMENTS`
elements on the second finest grid.

The *judged* decade starts where `elements_min` elements touch on the second finest grid of the Hurst exponent. There β
of vt/h tends to H/(1 + H) if the whole 95 % interval of its limit lies within `TOLERANCE`. It does not if the interval
lies outside. Otherwise the limit is open.
"""

from collections import defaultdict

import numpy as np
import pandas as pd

from viscorough.reference import exponent_beta
from viscorough_study.ensembles.averages import ROUNDING
from viscorough_study.ensembles.flat_punch import punch_stiffness
from viscorough_study.ensembles.nested_grids import PER_DECADE
from viscorough_study.fits.fine_sentence import TOLERANCE
from viscorough_study.fits.intervals import UNDEFINED, described, equivalence, interval, three_columns
from viscorough_study.fits.multilevel import Nest, grid_means, simulated, slope_weights

QUANTITIES = {"whole": "vt/h", "interface": "vt/h less X/κ_c of the punch"}
FINDINGS = {True: "within", False: "outside", None: "open"}
LAST_ELEMENTS = 10  # elements in contact from which a grid is the coarser of the two that the remainder continues
# Decades of X start at this many X per decade; it divides PER_DECADE.
STARTS = 10
SETS = 1000  # default number of simulated sets of discs for `power` and `coverage`
# Leave a grid out of a decade if β scatters less between discs: a single element touches, and β is 1 on all of them.
_LEAST_SCATTER = 1e-6

EXPONENTS = {
    "hurst": ("Hurst exponent", "1"),
    "quantity": ("; ".join(f"{name}: {text}" for name, text in QUANTITIES.items()), ""),
    "x_low": ("X at which the decade starts, with h over all waves of the spectrum", "1"),
    "across": ("elements across the discs on the grid", "1"),
    "discs": ("discs that are indented on this grid up to the end of the decade", "1"),
    "touching": ("median of the elements in contact on the grid, at x_low", "1"),
    "finest": ("1 for the finest grid whose curves reach the end of the decade, else 0", "1"),
    **described("beta", "exponent β in the decade, on this grid"),
    **described("limit", "middle of the interval of β on an infinitely fine grid"),
    "expected": ("H/(1 + H), Eq. 10", "1"),
    "judged": ("1 for the decade of the smallest X, by which the limit is judged, else 0", "1"),
    "finding": ("; ".join(FINDINGS.values()) + f": interval of the limit within H/(1 + H) ± {TOLERANCE:g}", ""),
    "power": ("share of simulated sets of discs that are found within, if β is H/(1 + H) on all grids", "1"),
    "coverage": ("share of the intervals of β on the finest grid that contain β in these sets", "1"),
}


def fine_exponents(datasets, *, elements_min, seed, sets=SETS):
    """Return the table of exponents, with the columns `EXPONENTS`.

    datasets : results of ensembles.nested_grids.nested_curves; batches of the same nest are joined in their order
    elements_min : smallest median of the elements in contact at the lower end of a decade
    seed, sets : seed and number of the simulated sets of discs
    """
    batches = defaultdict(list)
    for dataset in datasets:
        batches[dataset["hurst"].item(), tuple(dataset["elements"].values.tolist())].append(dataset)
    nests = defaultdict(list)
    for (hurst, grids), parts in sorted(batches.items()):
        nests[hurst].append(_Curves(grids, parts))
    rows = [
        {"hurst": hurst, "quantity": quantity} | row
        for hurst, curves in nests.items()
        for quantity in QUANTITIES
        for row in _rows(curves, quantity, hurst, elements_min, seed, sets)
    ]
    return pd.DataFrame(rows, columns=list(EXPONENTS))


class _Curves:
    """Curves of the discs of a nest.

    grids : elements across, from fine to coarse
    x : abscissae, shape (abscissae,); the curves of all nests start at the same X
    logarithm, count : ln(vt/h) and elements in contact, shape (discs, sides, grids, abscissae)
    """

    def __init__(self, grids, datasets):
        self.grids, self.x = grids, datasets[0]["x"].values
        self.logarithm, self.count = (
            np.concatenate([dataset[name].values for dataset in datasets]) for name in ("log_velocity", "contact_count")
        )

    def slopes(self, quantity, first, last):
        """Return the `Nest` of β from abscissa `first` to `last`, both included, as a mean over the sides of a disc."""
        part = slice(first, last + 1)
        values, x = self.logarithm[..., part], self.x[part]
        if quantity == "interface":
            punches = np.array([punch_stiffness(across) for across in self.grids])
            values = np.log(np.exp(values) - x / punches[:, None])
        slopes = (values @ slope_weights(np.log(x))).mean(axis=1)
        kept = slopes.std(axis=0) > _LEAST_SCATTER
        return Nest(tuple(np.array(self.grids)[kept].tolist()), slopes[:, kept])

    def reaches(self, x):
        return self.x[-1] >= x * (1 - ROUNDING)


def _touching(nests):
    """Return {elements across: median of the elements in contact, over the discs of all nests, at each abscissa}."""
    longest = max(len(nest.x) for nest in nests)
    medians = {}
    for across in sorted({across for nest in nests for across in nest.grids}):
        counts = [np.concatenate(nest.count[:, :, nest.grids.index(across)]) for nest in nests if across in nest.grids]
        padded = [np.pad(c, ((0, 0), (0, longest - c.shape[1])), constant_values=np.nan) for c in counts]
        reached = max(c.shape[1] for c in counts)
        medians[across] = np.nanmedian(np.concatenate(padded)[:, :reached], axis=0)
    return medians


def _starts(x):
    """Return the positions of the abscissae at which decades start."""
    numbers = STARTS * np.log10(x)
    return np.flatnonzero(np.abs(numbers - np.round(numbers)) < 1e-6)


def judged_start(touching, x, elements_min):
    """Return the position of the abscissa at which the judged decade starts, or None.

    touching : {elements across: median of the elements in contact at each abscissa}; x : abscissae
    """
    second = touching[sorted(touching)[-2]]
    return next((start for start in _starts(x[: len(second)]) if second[start] >= elements_min), None)


def _rows(nests, quantity, hurst, elements_min, seed, sets):
    """Yield the rows of a quantity and Hurst exponent: all decades, and all grids on which enough elements touch."""
    touching = _touching(nests)
    x = max((nest.x for nest in nests), key=len)
    finest, judged = max(touching), judged_start(touching, x, elements_min)
    for start in _starts(x):
        used = [nest for nest in nests if nest.reaches(10 * x[start])]
        grids = sorted({across for nest in used for across in nest.grids})
        shown = [across for across in grids if touching[across][start] >= elements_min]
        if not shown:
            continue
        samples = [nest.slopes(quantity, start, start + PER_DECADE) for nest in used]
        means = grid_means(samples)
        for across in shown:
            is_finest = across == grids[-1]
            continued = is_finest and len(grids) > 1 and touching[grids[-2]][start] >= LAST_ELEMENTS
            row = {
                "x_low": x[start],
                "across": across,
                "discs": sum(len(nest.values) for nest in samples if across in nest.grids),
                "touching": touching[across][start],
                "finest": int(is_finest),
                **three_columns("beta", means.on(across)),
                **three_columns("limit", means.limit(hurst) if continued else UNDEFINED),
                "expected": exponent_beta(hurst),
                "judged": int(across == finest and start == judged),
                "finding": "",
            }
            if row["judged"]:
                row["finding"] = finding(interval(row, "limit"), row["expected"])
                row |= _chances(samples, hurst, row["expected"], seed, sets)
            yield row


def finding(limit, expected):
    """Return whether an exponent tends to a law on fine grids; the result is a value of `FINDINGS`.

    limit : (value, low, high) of the limit; expected : exponent of the law
    """
    return FINDINGS[equivalence(limit[1:], expected - TOLERANCE, expected + TOLERANCE)]


def _chances(samples, hurst, expected, seed, sets):
    """Return `power` and `coverage`: shares of simulated sets whose exponent is that of the law on all grids."""
    estimates = list(simulated(samples, expected, sets, seed))
    within = [finding(means.limit(hurst), expected) == FINDINGS[True] for means in estimates]
    ends = np.array([means.on(means.grids[-1])[1:] for means in estimates])
    covered = (ends[:, 0] <= expected) & (expected <= ends[:, 1])
    return {"power": np.mean(within), "coverage": np.mean(covered)}
