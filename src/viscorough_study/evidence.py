"""The evidence by which the paper's claims are judged, and the outcome of one case of a claim."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd
import xarray as xr

from viscorough_study import pool
from viscorough_study.conventions import of_source, select
from viscorough_study.paper_data import number
from viscorough_study.power_law import find_region

VERDICTS = ("reproduced", "reproduced under a stated convention", "not reproduced", "not testable")
UNDEFINED = (np.nan, np.nan, np.nan)  # value and interval of a quantity that cannot be computed


@dataclass(frozen=True)
class Evidence:
    """What claims are judged by.

    discs : pool of the base discs (viscorough_study.pool)
    scaling, validation, direct : the tables of these names
    numbers : content of resources/paper/numbers.yaml; conventions : those of the figures, {convention: value}
    across : elements across a disc; limits : arguments of viscorough_study.power_law.find_region
    rules : interval_ratio_max, decades_min and end_decades, as the settings in section `verdicts`
    resamples, seed : of bootstraps
    """

    discs: xr.Dataset
    scaling: pd.DataFrame
    validation: pd.DataFrame
    direct: pd.DataFrame
    numbers: dict
    conventions: dict
    across: int
    limits: dict
    rules: dict
    resamples: int
    seed: int

    @cached_property
    def pooled(self):
        """{H: all discs of this exponent as one ensemble, in the rms convention of the figures}, by ascending H."""
        ensembles = sorted(pool.ensembles(self._discs, "hurst").items())
        return {hurst: ensemble.isel(rms_convention=0) for hurst, ensemble in ensembles}

    @cached_property
    def combinations(self):
        """{H: ensemble of every combination of force, viscosity, size and rms height}, otherwise as `pooled`."""
        by_case = {hurst: pool.ensembles(pool.select(self._discs, hurst=hurst), "case") for hurst in self.pooled}
        return {hurst: [one.isel(rms_convention=0) for one in cases.values()] for hurst, cases in by_case.items()}

    @property
    def _discs(self):
        return self.discs.sel(rms_convention=[self.conventions["rms_convention"]])

    @cached_property
    def regions(self):
        """{H: window (X_low, X_high) of region (b) of the pooled discs, None without one}."""
        return {hurst: self._region(ensemble) for hurst, ensemble in self.pooled.items()}

    def _region(self, ensemble):
        try:
            return find_region(ensemble, **self.limits)
        except ValueError:
            return None

    def fits(self, source, **wanted):
        """Base fits of "discs" or "lines", a row for each Hurst exponent, in the conventions of the figures.

        wanted : conventions in place of those of the figures
        """
        wanted = self.conventions | wanted | of_source(source) | {"case_group": "base"}
        return select(self.scaling, wanted).set_index("hurst")

    def said(self, section, name):
        """A number that the paper states (resources/paper/numbers.yaml)."""
        return number(self.numbers, section, name)

    def may_lie_within(self, interval, low, high):
        """Whether a quantity with this 95 % interval may lie in a range; None where the interval is too wide to tell.

        It is too wide if it is more than interval_ratio_max times as wide as the range.
        """
        if interval[0] > high or interval[1] < low:
            return False
        return True if interval[1] - interval[0] <= self.rules["interval_ratio_max"] * (high - low) else None


@dataclass(frozen=True)
class Case:
    """Outcome of one case of a claim.

    name : Hurst exponent or part that the case is about; expected : what the paper says, nan if it is not a number
    value, low, high : the quantity and its 95 % interval, or its least and largest value
    convention : in which the claim holds where it does not in those of the figures
    """

    name: str
    value: float
    low: float
    high: float
    expected: float
    verdict: str
    convention: str = ""


def judged(name, values, expected, met, convention=""):
    """Case with its verdict.

    values : value, low, high; met : whether the criterion is met, None where that cannot be said
    convention : in which it is met where it is not in those of the figures, if any
    """
    if met is None or not np.isfinite(values[0]):
        return Case(name, *values, expected, "not testable")
    if met:
        return Case(name, *values, expected, "reproduced")
    if convention:
        return Case(name, *values, expected, "reproduced under a stated convention", convention)
    return Case(name, *values, expected, "not reproduced")
