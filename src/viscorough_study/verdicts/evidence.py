"""Hold the results by which the paper's claims are judged, and judge the cases of a claim.

A claim is tested in several cases, such as one case for each Hurst exponent. Each case has a separate verdict.
"""

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

# Verdicts, from best to worst. A claim is tested in several cases. It is reproduced in part if some cases hold and
# others fail (verdicts.claims.overall); a single case never has this verdict.
VERDICTS = (
    "reproduced",
    "reproduced under a stated convention",
    "reproduced in part",
    "undecided",
    "not reproduced",
)
# {True if the criterion is met, False if it is not met, None if the data do not decide: verdict}
OUTCOMES = {True: "reproduced", False: "not reproduced", None: "undecided"}
# Keys of a case, which are also columns of the table of verdicts. verdicts.claims describes these columns.
CASE = ("case", "value", "low", "high", "least", "largest", "expected", "verdict")
CASE += ("convention", "conventions", "agreeing", "contradicting")
# Probability that a quantity lies below its 95 % interval. It lies above the interval with the same probability.
CONFIDENCE_TAIL = 0.025
# If there are few realizations, a verdict must also hold with intervals wider by this factor (`Evidence.within`).
FEW_WIDENED = 20.0


@dataclass(frozen=True)
class Evidence:
    """Results, settings and numbers of the paper by which claims are judged.

    A convention is a choice that the paper leaves open, such as the kind of average over realizations.

    discs : loading curves of the base discs, which all figures use, as made by viscorough_study.ensembles.pool
    tables : {name of a table: pandas.DataFrame}, all tables of the workflow that the criteria read
    numbers : content of resources/paper/numbers.yaml
    conventions : {convention: value}, the conventions of the figures
    surfaces : names of the groups of discs whose surfaces differ only in properties that the paper does not state
    across : number of elements across a disc
    limits : arguments of viscorough_study.fits.power_law.find_region
    rules : settings decades_min and end_decades of section `verdicts`
    resamples, seed : number of bootstrap samples, and seed of the bootstrap
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
        """Return {H: ensemble of all discs with this Hurst exponent}, by ascending H.

        The rms height h of the discs is measured as in the figures (`rms_convention` in `conventions`).
        """
        return dict(sorted(self._ensembles(self.discs, "hurst").items()))

    @cached_property
    def whole(self):
        """Return {H: ensemble of the discs whose curves extend to region (c)}, by ascending H.

        Only some of the discs in `pooled` have such curves, which were computed to the largest X (dimensionless force).
        """
        longest = pool.select(self.discs, until_x=self.discs["until_x"].values.max())
        return dict(sorted(self._ensembles(longest, "hurst").items()))

    @cached_property
    def combinations(self):
        """Return {H: list of ensembles}, with one ensemble for each combination of the physical parameters.

        A combination is a choice of force, viscosity, diameter and rms height.
        """
        return {h: list(self._ensembles(pool.select(self.discs, hurst=h), "case").values()) for h in self.pooled}

    def _ensembles(self, discs, name):
        return pool.ensembles(discs, name, rms_convention=self.conventions["rms_convention"])

    @cached_property
    def regions(self):
        """Return {H: (X_low, X_high), the ends of region (b)}, with None for an ensemble without such a region.

        There is an entry for every ensemble in `pooled`. X is the dimensionless force F/(4GhL).
        """
        return {hurst: find_region(ensemble, **self.limits) for hurst, ensemble in self.pooled.items()}

    def fits(self, source, **changed):
        """Return the power-law fits of "discs" or "lines" in the conventions of the figures.

        The table has one row for each Hurst exponent. Only base surfaces are included, which all figures use.
        changed : {convention: value}, values that replace the conventions of the figures
        """
        changed = self.conventions | changed | source_values(source) | {"case_group": "base"}
        return select(self.tables["scaling"], changed).set_index("hurst")

    def every_fit(self, source):
        """Return the power-law fits of "discs" or "lines" for every combination of conventions.

        Only conventions that change the fit itself are combined (fits.conventions.FITTED). The table has the fits of
        all groups in `surfaces`.
        """
        table = self.tables["scaling"]
        return table[(table["source"] == source) & table["case_group"].isin(self.surfaces)]

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

    def case(self, name, values, expected, allowed, *, extremes=NO_INTERVAL, **counted):
        """Judge whether a quantity lies in the allowed range; return the result for one case of a claim (see `judged`).

        name : name of the case; expected : value of the paper, or nan
        values : value and 95 % interval of the quantity; allowed : (low, high); extremes : (least, largest) value
        counted : arguments `realizations` and `cases` of `within`
        """
        return judged(name, values, expected, self.within(values, *allowed, **counted), extremes=extremes)

    def case_in_combinations(self, name, values, expected, allowed, combinations, **counted):
        """Judge a quantity that was computed in several combinations of conventions; return the result (see `judged`).

        Conventions are choices that the paper leaves open, such as the kind of mean.
        values : value and 95 % interval of the quantity in the conventions of the figures
        combinations : `Combinations`, the values of the quantity in all conventions
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
        """Judge whether a quantity follows a law, in all conventions; yield a result (see `judged`) for each H.

        own : table of the quantity in the conventions of the figures, indexed by H
        every : table of the quantity in every combination of conventions. It has the column `hurst` and the columns
            `names`.
        column : column of the quantity in both tables; law : `Law`
        names : columns of `every` that together name a combination
        compared : mask of rows of `every`. Only these rows are searched for a combination in which the claim holds for
            every H.
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
    """Values of a quantity that a claim is about, in every combination of conventions.

    Conventions are choices that the paper leaves open, such as the kind of mean. The claim is tested in several cases,
    such as one case for each Hurst exponent. Each case has a `Combinations`.

    values : value and 95 % interval of the quantity, shape (combinations, 3)
    holds_in : text that names a combination in which all cases of the claim hold; "" if there is none
    own : text that names the combination in which the case is judged; "" if these are the conventions of the figures
    """

    values: np.ndarray | list
    holds_in: str = ""
    own: str = ""


@dataclass(frozen=True)
class Law:
    """A law for a quantity as a function of H, and the tolerance of the claim that the quantity follows this law.

    value : the law, a function of H
    tolerance : largest deviation from the law that the claim allows
    relative : True if the tolerance is relative to the value of the law
    """

    value: Callable
    tolerance: float
    relative: bool = False

    def allowed_deviation(self, hurst):
        """Return the largest absolute deviation from the law that the claim allows at this Hurst exponent."""
        return abs(self.value(hurst)) * self.tolerance if self.relative else self.tolerance


def widened(values, factor):
    """Widen an interval about its value by a factor, and return the new ends (low, high).

    values : (value, low, high)
    """
    value, low, high = values
    return value - factor * (value - low), value + factor * (high - value)


def hurst_name(hurst):
    """Return the text for a Hurst exponent in names of cases, such as "H = 0.4"."""
    return f"H = {hurst:g}"


def judged(name, values, expected, met, convention="", *, extremes=NO_INTERVAL, counts=(np.nan,) * 3):
    """Return the result for one case of a claim, with its verdict, as a dict with the keys `CASE`.

    A claim is tested in several cases, such as one case for each Hurst exponent.

    name : name of the case; values : (value, low, high) of the tested quantity; expected : value of the paper, or nan
    met : True if the criterion is met, and no other choice of conventions contradicts it. False if the criterion is
        not met, or is met only in some conventions. None if the data do not decide (`Evidence.within`). If the value is
        nan, the case is always undecided.
    convention : text that names conventions that meet the criterion although `met` is not True; "" if there are none
    extremes : (least, largest) value of the tested quantity, for example of all grids
    counts : entries of the columns conventions, agreeing and contradicting
    """
    if not np.isfinite(values[0]):
        met, convention = None, ""
    elif met:
        convention = ""
    verdict = "reproduced under a stated convention" if convention else OUTCOMES[met]
    return dict(zip(CASE, (name, *values, *extremes, expected, verdict, convention, *counts), strict=True))


def exact(name, value, expected, met, values):
    """Return the result of `judged` for a quantity without statistical scatter, which has no interval.

    name, expected : see `judged`; value : tested value; met : True if the criterion is met
    values : samples of the quantity; the result contains the least and the largest sample
    """
    extremes = min(values, default=np.nan), max(values, default=np.nan)
    return judged(name, (float(value), *NO_INTERVAL), expected, bool(met), extremes=extremes)
