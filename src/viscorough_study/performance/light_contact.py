"""One light load on a square map, as on a scan: growth of the cost with the size of the map, and other solvers.

The whole map is read, and pressure and gap are computed everywhere. The time that no solver can do without is that of
reading the map and ranking the elements that can touch.
"""

import logging
from dataclasses import dataclass
from functools import partial
from types import SimpleNamespace

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough.contact.one_contact import contact_at
from viscorough.contact.ranking import Ranking
from viscorough.indenter import Indenter
from viscorough.surfaces import self_affine_square
from viscorough_study.performance import solver_comparison, timing
from viscorough_study.performance.other_solvers import contact_residual
from viscorough_study.run.seeds import light_map_key, realization_seed

# Other solvers are stopped after this many times our time, or after the shortest time.
SLOWER, SHORTEST = 20, 2.0  # [s]
# Most repetitions of our own solutions, of which a small map takes as many as last SHORTEST.
MOST_REPEATS = 40
# Corrections of the force towards a contact fraction, and the tolerance of the contacts that tell it.
CORRECTIONS, TOLERANCE = 3, 1e-2
COLUMNS = {
    "fraction": ("contact fraction that the load was chosen for", "1"),
    **{name: text for name, text in solver_comparison.COLUMNS.items() if name not in ("task", "levels", "force_error")},
    "over_depth": ("time of our solution on one thread over that at the depth instead, run in turn, of medians", "1"),
    "ranking_s": ("time of reading the map and ranking the elements that can touch, median", "s"),
}


@dataclass(frozen=True)
class LightLoad(solver_comparison.Task):
    """A load on a map; depths : of the contact, shape (1,); force : F/G."""

    force: float = 0.0

    def exact_forces(self):
        """The load itself."""
        return np.array([self.force])

    def solve(self, threads):
        """The Contact under the load, with its maps."""
        return contact_at(self.indenter, force=self.force, tolerance=self.residual, threads=threads)

    def solve_at_depth(self):
        """The Contact at the depth, on one thread."""
        return contact_at(self.indenter, depth=self.depths[0], tolerance=self.residual)

    def rank(self):
        """What no solution can do without: the elements that can touch, in order."""
        ranking = Ranking(self.indenter)
        return ranking.first(self.depths[0] / ranking.units.length)

    def outcome(self, solution):
        """Residual, by the measure of all solvers, and force; the number of iterations is not reported."""
        gap = self.indenter.initial_gap / self.indenter.spacing
        residual = contact_residual(gap, np.nan_to_num(solution.pressure))
        return SimpleNamespace(residual=np.array([residual]), force=np.array([solution.force]), iterations=-1)


def time_light_contact(*, seed, hurst, residual, elements, fractions, threads, race, pairs, peers):
    """Table of the columns `COLUMNS` of one load for every map and contact fraction.

    elements, fractions : of the growth of the cost, one map for each number of elements across
    race : {elements, fractions} of the comparison with other solvers
    threads : numbers of threads; residual : to be reached; peers : as of solver_comparison.time_other_solvers
    """
    solvers, stopped, tables = solver_comparison.installed_solvers(peers), set(), []
    threadpool_limits(1)  # of linear algebra; Snakemake gives the job all cores, so that no other job runs
    for across in sorted({*elements, *race["elements"]}):
        is_raced = across in race["elements"]
        seed_of_map = realization_seed(seed, *light_map_key(hurst, across, 0))
        indenter = Indenter(self_affine_square(hurst, across, seed=seed_of_map), 1.0)
        for fraction in sorted({*(fractions if across in elements else ()), *(race["fractions"] if is_raced else ())}):
            logging.info("%d x %d elements, contact of %g", across, across, fraction)
            load = light_load(hurst, indenter, fraction, residual, threads)
            _, seconds, _ = timing.timed(partial(load.solve, 1))
            is_race = is_raced and fraction in race["fractions"]
            racing = {name: command for name, command in solvers.items() if is_race and (name, fraction) not in stopped}
            limits = {"pairs": pairs, "time_limit": max(SHORTEST, SLOWER * seconds)}
            table = solver_comparison.compare_solvers(load, racing, **limits)
            # One that did not finish is not waited for again on a larger map.
            stopped |= {(name, fraction) for name in racing if name not in set(table["solver"])}
            own = {"force": partial(load.solve, 1), "depth": load.solve_at_depth, "ranking": load.rank}
            times = timing.interleaved(own, max(pairs, min(MOST_REPEATS, int(SHORTEST / seconds))))
            at_force, at_depth, ranking = (times[name][0] for name in own)
            tables.append(table.assign(fraction=fraction, over_depth=at_force / at_depth, ranking_s=ranking))
    return pd.concat(tables)[list(COLUMNS)]


def light_load(hurst, indenter, fraction, residual, threads):
    """The LightLoad for a contact fraction, which nearly is proportional to the force.

    The first guess is that of light contact between rough surfaces, F = ½ E* h′ A with E* = 4G, contact area A and rms
    slope h′ (Persson 2001, Hyun et al. 2004).
    """
    force = 2 * indenter.rms_slope * fraction * indenter.elements * indenter.spacing**2
    for _ in range(CORRECTIONS):
        contact = contact_at(indenter, force=force, tolerance=TOLERANCE)
        force *= fraction / contact.contact_fraction
    depth = contact_at(indenter, force=force, tolerance=TOLERANCE).depth
    name = f"{100 * fraction:g} % at {len(indenter.heights)}"
    return LightLoad(name, hurst, indenter, np.array([depth]), residual, tuple(threads), force=force)
