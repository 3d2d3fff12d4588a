"""Hold the evidence for judging the paper's claims, and make the cases of a claim with their verdicts."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd
import xarray as xr
from scipy.special import ndtri

from viscorough_study.ensembles import pool
from viscorough_study.fits.conventions import FITTED, as_text, select, source_values
from viscorough_study.fits.intervals import NO_INTERVAL, equivalence, interval
from viscorough_study.fits.power_law import find_region

# Verdicts on claims, from best to worst. Only a claim can be reproduced in part, if some of its cases hold and others
# fail (verdicts.claims.overall); a single case has one of the other verdicts.
VERDICTS = (
    "reproduced",
    "reproduced under a stated convention",
    "reproduced in part",
    "undecided",
    "not reproduced",
)
# Verdict on a case by whether the criterion is met; None: the data do not decide.
OUTCOMES = {True: "reproduced", False: "not reproduced", None: "undecided"}
# Columns of a case in the table of verdicts. verdicts.claims describes these columns.
CASE = ("case", "value", "low", "high", "least", "largest", "expected", "verdict")
CASE += ("convention", "conventions", "agreeing", "contradicting")
CONFIDENCE_TAIL = 0.025  # probability that a quantity lies below a 95 % interval, or above
# Verdicts from few realizations must remain when intervals are widened by this factor (`Evidence.within`).
FEW_WIDENED = 20.0


@dataclass(frozen=True)
class Evidence:
    """Results, settings and numbers of the paper by which claims are judged.

    discs : pool of the base discs (viscorough_study.ensembles.pool)
    tables : {name: pandas.DataFrame} of the tables of the workflow that some criterion reads
    numbers : content of resources/paper/numbers.yaml
    conventions : conventions of the figures, {convention: value}
    surfaces : groups of cases whose surfaces differ only in conventions that the paper leaves open
    across : elements across a disc
    limits : arguments of viscorough_study.fits.power_law.find_region
    rules : decades_min and end_decades, settings of section `verdicts`
    resamples, seed : arguments of bootstraps
    """

    discs: xr.Dataset
    tables: dict[str, pd.DataFrame]
    numbers: dict
    conventions: dict
    surfaces: list
    across: int
    limits: dict
    rules: dict
    resamples: int
    seed: int

    @cached_property
    def pooled(self):
        """Return {H: ensemble of all discs of this Hurst exponent}, by ascending H, in the figures' rms convention."""
        return dict(sorted(self._ensembles(self.discs, "hurst").items()))

    @cached_property
    def whole(self):
        """Return {H: ensemble of the discs whose curves extend to region (c)}, by ascending H.

        These discs, a part of `pooled`, are those whose curves were computed to the largest X.
        """
        longest = pool.select(self.discs, until_x=self.discs["until_x"].values.max())
        return dict(sorted(self._ensembles(longest, "hurst").items()))

    @cached_property
    def combinations(self):
        """Return {H: list of ensembles}, one for each combination of force, viscosity, diameter and rms height."""
        return {h: list(self._ensembles(pool.select(self.discs, hurst=h), "case").values()) for h in self.pooled}

    def _ensembles(self, discs, name):
        return pool.ensembles(discs, name, rms_convention=self.conventions["rms_convention"])

    @cached_property
    def regions(self):
        """Return {H: window (X_low, X_high) of region (b) of the ensemble in `pooled`, or None without a region}."""
        return {hurst: find_region(ensemble, **self.limits) for hurst, ensemble in self.pooled.items()}

    def fits(self, source, **changed):
        """Return the fits of "discs" or "lines" in the conventions of the figures, one row per Hurst exponent.

        Only fits of base surfaces are returned. changed : {convention: value} that replaces the conventions of the
        figures
        """
        changed = self.conventions | changed | source_values(source) | {"case_group": "base"}
        return select(self.tables["scaling"], changed).set_index("hurst")

    def every_fit(self, source):
        """Return the fits of "discs" or "lines" in every convention that needs a fit, for all groups in `surfaces`."""
        table = self.tables["scaling"]
        return table[(table["source"] == source) & table["case_group"].isin(self.surfaces)]

    def paper_value(self, section, name):
        """Return a number that the paper states (resources/paper/numbers.yaml)."""
        return self.numbers[section][name]["value"]

    def are_few(self, realizations):
        """Return True if this number of realizations is below the number that the paper averages for a curve."""
        return realizations < self.paper_value("boundary_elements", "realizations_min")

    def within(self, values, low, high, *, realizations, cases=1):
        """Return True if a quantity lies in the range from low to high, False if it lies outside, None if undecided.

        values : (value, low end, high end), with the 95 % interval of the quantity
        realizations : number of realizations behind the value; cases : number of cases of the claim

        A claim holds if all its cases lie within the range. For this test the separate intervals of the cases are valid
        (intersection-union test: Berger, Technometrics 24, 295 (1982)). A single case outside refutes the claim. Since
        one of many cases may be outside by chance, this test uses intervals that are widened so that all of them
        together hold with 95 % (Bonferroni).

        If there are fewer realizations than the paper averages, the verdict must also hold with intervals `FEW_WIDENED`
        times as wide. By Chebyshev's inequality a quantity lies beyond such an interval in less than 0.07 % of all
        draws, for any distribution. So a run at reduced scale decides only cases that other surfaces would confirm, and
        leaves the others undecided.
        """
        factor = FEW_WIDENED if self.are_few(realizations) else 1.0
        if equivalence(widened(values, factor), low, high):
            return True
        together = ndtri(1 - CONFIDENCE_TAIL / cases) / ndtri(1 - CONFIDENCE_TAIL)
        return False if equivalence(widened(values, factor * together), low, high) is False else None

    def case(self, name, values, expected, allowed, *, extremes=NO_INTERVAL, **counted):
        """Return the case of a quantity that must lie in the allowed range: a dict with its verdict (`judged`).

        name : name of the case; expected : value of the paper, or nan
        values : value and 95 % interval; allowed : (low, high); extremes : (least, largest) value
        counted : arguments `realizations` and `cases` of `within`
        """
        return judged(name, values, expected, self.within(values, *allowed, **counted), extremes=extremes)

    def case_in_combinations(self, name, values, expected, allowed, combinations, **counted):
        """Return the case of a quantity that was computed in several conventions which the paper leaves open.

        values : value and 95 % interval in the conventions of the figures
        combinations : `Combinations`, the quantity in all conventions
        The other arguments are described in `case`. With few realizations the combinations are ignored, because the
        data do not show which combinations meet the criterion.
        """
        if self.are_few(counted["realizations"]):
            return self.case(name, values, expected, allowed, **counted)
        met, holds_in = self.within(values, *allowed, **counted), combinations.holds_in
        decided = [self.within(combination, *allowed, **counted) for combination in combinations.values]
        counts = (len(decided), decided.count(True), decided.count(False))
        if met and counts[2]:
            met, holds_in = False, combinations.own or as_text({name: self.conventions[name] for name in FITTED})
        return judged(name, values, expected, met, holds_in, counts=counts)

    def cases_in_conventions(self, own, every, column, law, *, names, compared=True):
        """Yield the cases of a quantity that must follow a law, one for each H, with its values in all conventions.

        own : table of the quantity in the conventions of the figures, indexed by H
        every : table of the quantity in every combination of conventions, with the column `hurst` and the columns
            `names`
        column : column of the quantity; law : `Law`
        names : columns that together name a combination
        compared : mask of the rows of `every` that are searched for a combination in which all cases of the claim hold
        """
        columns = [column, f"{column}_low", f"{column}_high"]
        deviation = every[columns[1:]].sub(law.value(every["hurst"]), axis=0).abs().max(axis=1, skipna=False)
        distance = deviation / law.allowed_deviation(every["hurst"])
        mask, holds_in = compared & every["hurst"].isin(own.index), ""
        largest = distance.fillna(np.inf)[mask].groupby([every[name] for name in names], sort=False).max()
        if largest.min() <= 1:
            holds_in = as_text(dict(zip(names, largest.idxmin(), strict=True)))
        for hurst, row in own.iterrows():
            values = every.loc[every["hurst"] == hurst, columns].dropna().to_numpy()
            counted = {"realizations": row["realizations"], "cases": len(own)}
            expected, half = law.value(hurst), law.allowed_deviation(hurst)
            ends, combinations = (expected - half, expected + half), Combinations(values, holds_in)
            yield self.case_in_combinations(
                hurst_name(hurst), interval(row, column), expected, ends, combinations, **counted
            )


@dataclass(frozen=True)
class Combinations:
    """Values of a quantity in every combination of the conventions that the paper leaves open.

    values : value and 95 % interval of the quantity, shape (combinations, 3)
    holds_in : the combination, in words, that makes every case of the claim hold; "" if there is none
    own : the combination of the case itself, in words; by default the conventions of the figures
    """

    values: np.ndarray | list
    holds_in: str = ""
    own: str = ""


@dataclass(frozen=True)
class Law:
    """A law for a quantity as a function of H, and the tolerance of the claim that the quantity follows this law.

    value : function of H
    tolerance : largest deviation from the law that the claim allows
    relative : whether the tolerance is relative to the value of the law
    """

    value: Callable
    tolerance: float
    relative: bool = False

    def allowed_deviation(self, hurst):
        """Return the largest absolute deviation from the law that the claim allows at a Hurst exponent."""
        return abs(self.value(hurst)) * self.tolerance if self.relative else self.tolerance


def widened(values, factor):
    """Return the ends (low, high) of a widened interval.

    The distances of its ends from the value are multiplied by a factor. values : (value, low, high)
    """
    value, low, high = values
    return value - factor * (value - low), value + factor * (high - value)


def hurst_name(hurst):
    """Return the name of the case of a Hurst exponent, such as "H = 0.4"."""
    return f"H = {hurst:g}"


def judged(name, values, expected, met, convention="", *, extremes=NO_INTERVAL, counts=(np.nan,) * 3):
    """Return a case with its verdict: a dict with the keys `CASE`.

    name : name of the case; values : (value, low, high); expected : value of the paper, or nan
    met : True if the criterion is met, and no convention that the paper leaves open contradicts; False if it is not
        met, or only in some conventions; None if the data do not decide (`Evidence.within`). A case with an undefined
        value is always undecided.
    convention : conventions, in words, that meet the criterion although `met` is not True; "" if there are none
    extremes : (least, largest) value; counts : entries of the columns conventions, agreeing and contradicting
    """
    if not np.isfinite(values[0]):
        met, convention = None, ""
    elif met:
        convention = ""
    verdict = "reproduced under a stated convention" if convention else OUTCOMES[met]
    return dict(zip(CASE, (name, *values, *extremes, expected, verdict, convention, *counts), strict=True))


def exact(name, value, expected, met, values):
    """Return the case of a quantity without statistical scatter; values : samples, for the least and largest value"""
    extremes = min(values, default=np.nan), max(values, default=np.nan)
    return judged(name, (float(value), *NO_INTERVAL), expected, bool(met), extremes=extremes)
