"""Hold the evidence for judging the paper's claims, and the outcome of one case of a claim."""

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

# Verdicts on claims, from best to worst. A case cannot have the verdict "reproduced in part" (verdicts.claims.overall).
VERDICTS = (
    "reproduced",
    "reproduced under a stated convention",
    "reproduced in part",
    "undecided",
    "not reproduced",
)
OUTCOMES = {True: "reproduced", False: "not reproduced", None: "undecided"}  # {criterion is met: its verdict}
# Columns of a case in the table of verdicts (verdicts.claims), which describes them.
CASE = ("case", "value", "low", "high", "least", "largest", "expected", "verdict")
CASE += ("convention", "conventions", "agreeing", "contradicting")
CONFIDENCE_TAIL = 0.025  # probability beyond either end of an interval
FEW_WIDENED = 20.0  # widening factor that verdicts from few realizations must survive


@dataclass(frozen=True)
class Evidence:
    """Data, settings and numbers of the paper for judging claims.

    discs : pool of the base discs (viscorough_study.ensembles.pool)
    tables : {name: pandas.DataFrame} of the tables of the workflow that some criterion reads
    numbers : content of resources/paper/numbers.yaml; conventions : conventions of the figures, {convention: value}
    surfaces : groups of cases whose surfaces differ only in conventions that the paper leaves open
    across : elements across a disc; limits : arguments of viscorough_study.fits.power_law.find_region
    rules : decades_min and end_decades, as the settings in section `verdicts`
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
        """Return {H: all discs of this exponent as one ensemble, in the figures' rms convention}, by ascending H."""
        return dict(sorted(self._ensembles(self.discs, "hurst").items()))

    @cached_property
    def whole(self):
        """Return {H: the discs of `pooled` whose curves extend to region (c)}, the discs with the largest X."""
        longest = pool.select(self.discs, until_x=self.discs["until_x"].values.max())
        return dict(sorted(self._ensembles(longest, "hurst").items()))

    @cached_property
    def combinations(self):
        """Return {H: list of the ensembles of all combinations of force, viscosity, size and rms height}."""
        return {h: list(self._ensembles(pool.select(self.discs, hurst=h), "case").values()) for h in self.pooled}

    def _ensembles(self, discs, name):
        return pool.ensembles(discs, name, rms_convention=self.conventions["rms_convention"])

    @cached_property
    def regions(self):
        """Return {H: window (X_low, X_high) of region (b) of the pooled discs, None without one}."""
        return {hurst: find_region(ensemble, **self.limits) for hurst, ensemble in self.pooled.items()}

    def fits(self, source, **changed):
        """Return base fits of "discs" or "lines", one row per Hurst exponent, in the conventions of the figures.

        changed : conventions that replace the conventions of the figures
        """
        changed = self.conventions | changed | source_values(source) | {"case_group": "base"}
        return select(self.tables["scaling"], changed).set_index("hurst")

    def every_fit(self, source):
        """Return fits of "discs" or "lines" in every convention that needs a fit, of all surfaces left open."""
        table = self.tables["scaling"]
        return table[(table["source"] == source) & table["case_group"].isin(self.surfaces)]

    def paper_value(self, section, name):
        """Return a number that the paper states (resources/paper/numbers.yaml)."""
        return self.numbers[section][name]["value"]

    def are_few(self, realizations):
        """Return True for fewer realizations than the paper averages for a curve."""
        return realizations < self.paper_value("boundary_elements", "realizations_min")

    def within(self, values, low, high, *, realizations, cases=1):
        """Decide if a quantity lies in the range from low to high; None if the data do not decide (`equivalence`).

        values : value and 95 % interval; realizations : their number; cases : number of cases of the claim

        A claim holds if all its cases lie within the range. For this test their separate intervals are valid
        (intersection-union test: Berger, Technometrics 24, 295 (1982)). A single case outside refutes the claim. Since
        one of many cases may be outside by chance, this test uses intervals widened to 95 % for all cases together
        (Bonferroni). Verdicts from fewer realizations than the paper averages must hold with intervals `FEW_WIDENED`
        times as wide: by Chebyshev's inequality a quantity lies beyond such an interval in less than 0.07 % of all
        draws, for any distribution. So a run at reduced scale decides only cases that other surfaces would confirm, and
        leaves the others undecided.
        """
        factor = FEW_WIDENED if self.are_few(realizations) else 1.0
        if equivalence(widened(values, factor), low, high):
            return True
        together = ndtri(1 - CONFIDENCE_TAIL / cases) / ndtri(1 - CONFIDENCE_TAIL)
        return False if equivalence(widened(values, factor * together), low, high) is False else None

    def case(self, name, values, expected, allowed, *, extremes=NO_INTERVAL, **counted):
        """Return the case of a quantity that must lie in the range allowed, (low, high): `judged` by `within`.

        values : value and 95 % interval; extremes : least and largest value
        counted : realizations and cases, for `within`
        """
        return judged(name, values, expected, self.within(values, *allowed, **counted), extremes=extremes)

    def case_in_combinations(self, name, values, expected, allowed, combinations, **counted):
        """Return the case of a quantity that is also known in other conventions that the paper leaves open.

        combinations : Combinations; few realizations do not show which of them fulfil a claim
        Further parameters are those of `case`.
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
        """Yield cases of a quantity that must be near the law, one for each H, with its values in all conventions.

        own, every : rows by H in the conventions of the figures, and in every combination, with `hurst` and names
        column : column of the quantity; law : Law
        names : columns that name a combination; compared : mask of the rows with combinations that count for the claim
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
    """A quantity in every combination of the conventions that the paper leaves open.

    values : value and 95 % interval, shape (combinations, 3)
    holds_in : combination in words in which every case of the claim holds, "" if there is none
    own : the combination of the case itself in words, by default the conventions of the figures
    """

    values: np.ndarray | list
    holds_in: str = ""
    own: str = ""


@dataclass(frozen=True)
class Law:
    """A law of a quantity over the Hurst exponent, and the tolerance of a claim that the quantity follows it.

    value : function of H; relative : True if the tolerance applies to the ratio to the law
    """

    value: Callable
    tolerance: float
    relative: bool = False

    def allowed_deviation(self, hurst):
        """Return the largest deviation from the law that a claim allows."""
        return abs(self.value(hurst)) * self.tolerance if self.relative else self.tolerance


def widened(values, factor):
    """Widen an interval: multiply the distances of its ends from the value by a factor; values : value, low, high"""
    value, low, high = values
    return value - factor * (value - low), value + factor * (high - value)


def hurst_name(hurst):
    """Return the name of the case of a Hurst exponent."""
    return f"H = {hurst:g}"


def judged(name, values, expected, met, convention="", *, extremes=NO_INTERVAL, counts=(np.nan,) * 3):
    """Return a case with its verdict: a dict with the keys `CASE`.

    values : value, low, high; extremes : least, largest
    met : True if the criterion is met in any convention, None if the data do not decide (`Evidence.within`); an
        undefined value is always undecided
    convention : the only convention that meets it, if any; counts : conventions, agreeing, contradicting
    """
    if not np.isfinite(values[0]):
        met, convention = None, ""
    elif met:
        convention = ""
    verdict = "reproduced under a stated convention" if convention else OUTCOMES[met]
    return dict(zip(CASE, (name, *values, *extremes, expected, verdict, convention, *counts), strict=True))


def exact(name, value, expected, met, values):
    """Return the case of a quantity without statistical scatter; values : samples that give its extremes"""
    extremes = min(values, default=np.nan), max(values, default=np.nan)
    return judged(name, (float(value), *NO_INTERVAL), expected, bool(met), extremes=extremes)
