"""Hold the results by which claims are judged, and judge the cases of a claim.

A claim is tested in several cases, such as one case for each Hurst exponent. Each case has a separate verdict.

Other random surfaces give other numbers, and a verdict must not depend on this choice. If a quantity has a 95 %
interval, a case holds only if the whole interval lies within the tolerance, and it does not hold only if the whole
interval lies outside. Otherwise it is undecided.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import pandas as pd
import xarray as xr
from scipy.special import ndtri

from viscorough_study.ensembles import pool
from viscorough_study.fits.conventions import READINGS, select, source_values
from viscorough_study.fits.intervals import NO_INTERVAL, equivalence
from viscorough_study.fits.power_law import find_region

# {True if the criterion is met, False if it is not met, None if the data do not decide: verdict of a case}
OUTCOMES = {True: "holds", None: "undecided", False: "not"}
# Keys of a case, which are also columns of the table of verdicts. verdicts.claims describes these columns.
CASE = ("case", "value", "low", "high", "least", "largest", "expected", "verdict", "note")
# Probability that a quantity lies below its 95 % interval. It lies above the interval with the same probability.
CONFIDENCE_TAIL = 0.025
# If there are few realizations, a verdict must also hold with intervals wider by this factor (`Evidence.within`).
FEW_WIDENED = 20.0


@dataclass(frozen=True)
class Evidence:
    """Results, settings and numbers of the paper by which claims are judged, in one reading of the paper's surfaces.

    The paper does not say how its discs were made. A claim that depends on this is judged in two readings
    (viscorough_study.fits.conventions.READINGS). In reading A the square has the period L, and h is the rms height of
    the disc. In reading B the disc is cut from a square of twice its diameter, and h is the rms height of the square.

    discs : pool of loading curves of discs (viscorough_study.ensembles.pool) with the groups of the readings
    tables : {name of a table: pandas.DataFrame}, all tables that the claims read
    numbers : content of resources/paper/numbers.yaml
    conventions : {convention: value}, the conventions of the figures, for the kind of mean and the window of a fit
    across : number of elements across a disc
    limits : arguments of viscorough_study.fits.power_law.find_region
    resamples, seed : number of bootstrap samples, and seed of the bootstrap
    reading : "A" or "B"
    """

    discs: xr.Dataset
    tables: dict[str, pd.DataFrame]
    numbers: dict
    conventions: dict
    across: int
    limits: dict
    resamples: int
    seed: int
    reading: str = "A"

    @property
    def readings(self):
        """Return {name of a reading: Evidence in this reading}, for each reading whose discs were computed."""
        groups = set(self.discs["group"].values.tolist())
        return {name: replace(self, reading=name) for name, own in READINGS.items() if own["group"] in groups}

    @cached_property
    def _discs_of_reading(self):
        return pool.select(self.discs, group=READINGS[self.reading]["group"])

    @cached_property
    def pooled(self):
        """Return {H: ensemble of all discs with this Hurst exponent}, by ascending H."""
        return dict(sorted(self._ensembles(self._discs_of_reading, "hurst").items()))

    @cached_property
    def whole(self):
        """Return {H: ensemble of the discs whose curves extend to region (c)}, by ascending H.

        Only some of the discs in `pooled` have such curves, which were computed to the largest X (dimensionless force).
        """
        longest = pool.select(self._discs_of_reading, until_x=self._discs_of_reading["until_x"].values.max())
        return dict(sorted(self._ensembles(longest, "hurst").items()))

    @cached_property
    def combinations(self):
        """Return {H: list of ensembles}, with one ensemble for each combination of the physical parameters.

        A combination is a choice of force, viscosity, diameter and rms height.
        """
        discs = self._discs_of_reading
        return {h: list(self._ensembles(pool.select(discs, hurst=h), "ensemble").values()) for h in self.pooled}

    def _ensembles(self, discs, name):
        return pool.ensembles(discs, name, rms_convention=READINGS[self.reading]["rms_convention"])

    @cached_property
    def regions(self):
        """Return {H: (X_low, X_high), the ends of region (b)}, with None for an ensemble without such a region.

        There is an entry for every ensemble in `pooled`. X is the dimensionless force F/(4GhL).
        """
        return {hurst: find_region(ensemble, **self.limits) for hurst, ensemble in self.pooled.items()}

    def fits(self, source, gamma="without"):
        """Return the power-law fits of "discs" of the reading, or of "lines", indexed by H.

        gamma : "with" or "without", for ζ of the law with or without the factor 1/Γ(2 − α)
        Fits without a region (b) have no exponent; their values are nan.
        """
        own = READINGS[self.reading] if source == "discs" else {"group": "base"}
        chosen = self.conventions | {"gamma": gamma} | own | source_values(source)
        return select(self.tables["scaling"], chosen).set_index("hurst")

    def of_reading(self, name):
        """Return the rows of a table that belong to the reading; the table has the column `reading`."""
        table = self.tables[name]
        return table[table["reading"] == self.reading]

    def of_discs(self, name):
        """Return the rows of a table that belong to the discs of the reading; the table has the column `group`."""
        table = self.tables[name]
        return table[table["group"] == READINGS[self.reading]["group"]]

    def paper_value(self, section, name):
        """Return a number that the paper states (resources/paper/numbers.yaml)."""
        return self.numbers[section][name]["value"]

    def are_few(self, realizations):
        """Return True if there are fewer realizations than the paper averages for a curve."""
        return realizations < self.paper_value("boundary_elements", "realizations_min")

    def within(self, values, low, high, *, realizations, cases=1):
        """Return True if a quantity lies in the range from low to high, False if it lies outside, None if undecided.

        values : (value, low end, high end), with the 95 % interval of the quantity
        realizations : number of surfaces from which the value was computed
        cases : number of cases of the claim, such as the number of Hurst exponents for which it is tested

        A claim holds only if all its cases lie in the range. The 95 % interval of each single case is valid for this
        test (intersection-union test: Berger, Technometrics 24, 295 (1982)). A claim fails if a single case lies
        outside. Among many cases, one may lie outside by chance. The test of failure therefore uses wider intervals,
        which hold together with a probability of 95 % (Bonferroni).

        If there are fewer realizations than the paper averages for a curve, the verdict must also hold with intervals
        `FEW_WIDENED` times as wide. By Chebyshev's inequality, a quantity with any distribution lies beyond such an
        interval in less than 0.07 % of all draws. A study with few realizations therefore decides only cases that other
        random surfaces would confirm, and leaves all other cases undecided.
        """
        factor = FEW_WIDENED if self.are_few(realizations) else 1.0
        if equivalence(widened(values, factor), low, high):
            return True
        together = ndtri(1 - CONFIDENCE_TAIL / cases) / ndtri(1 - CONFIDENCE_TAIL)
        return False if equivalence(widened(values, factor * together), low, high) is False else None

    def case(self, name, values, expected, allowed, *, extremes=NO_INTERVAL, note="", **counted):
        """Judge whether a quantity lies in the allowed range; return the result for one case of a claim (see `judged`).

        name : name of the case; expected : value of the paper, or nan; note : words on the case
        values : value and 95 % interval of the quantity; allowed : (low, high); extremes : (least, largest) value
        counted : arguments `realizations` and `cases` of `within`
        """
        met = self.within(values, *allowed, **counted)
        return judged(name, values, expected, met, extremes=extremes, note=note)


def widened(values, factor):
    """Widen an interval about its value by a factor, and return the new ends (low, high).

    values : (value, low, high)
    """
    value, low, high = values
    return value - factor * (value - low), value + factor * (high - value)


def hurst_name(hurst):
    """Return the text for a Hurst exponent in names of cases, such as "H = 0.4"."""
    return f"H = {hurst:g}"


def judged(name, values, expected, met, *, extremes=NO_INTERVAL, note=""):
    """Return the result for one case of a claim, with its verdict, as a dict with the keys `CASE`.

    A claim is tested in several cases, such as one case for each Hurst exponent.

    name : name of the case; values : (value, low, high) of the tested quantity; expected : value of the paper, or nan
    met : True if the criterion is met, False if it is not met, None if the data do not decide (`Evidence.within`). If
        the value is nan, the case is always undecided.
    extremes : (least, largest) value of the tested quantity, for example of all grids
    note : words on the case, such as the X to which it belongs
    """
    verdict = OUTCOMES[met if np.isfinite(values[0]) else None]
    return dict(zip(CASE, (name, *values, *extremes, expected, verdict, note), strict=True))


def exact(name, value, expected, met, values):
    """Return the result of `judged` for a quantity without statistical scatter, which has no interval.

    name, expected : see `judged`; value : tested value; met : True if the criterion is met
    values : samples of the quantity; the result contains the least and the largest sample
    """
    extremes = min(values, default=np.nan), max(values, default=np.nan)
    return judged(name, (float(value), *NO_INTERVAL), expected, bool(met), extremes=extremes)
