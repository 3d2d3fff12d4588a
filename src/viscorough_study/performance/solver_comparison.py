"""The elastic loading path compared with other solvers: the same levels of one indenter, to the same residual.

The time of the path includes its set-up and the exact stiffness at every level; that of another solver includes
neither. Other solvers start every level from the previous one, if they can.
"""

import logging
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough import __version__
from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
from viscorough.surfaces import self_affine_disc
from viscorough_study.performance import other_solvers, timing
from viscorough_study.run.seeds import realization_seed, solver_race_key

# Tolerances of other solvers, over the residual required, from loose to tight: each solver defines its own measure of
# the tolerance. The search for the loosest one that meets the residual begins at FIRST_RATIO.
TOLERANCE_RATIOS = (30, 10, 3, 1, 1 / 3, 1 / 10, 1 / 30, 1 / 100)
FIRST_RATIO = 3
# Ratio to the time of the fastest other solver that neither a looser tolerance nor noise of the machine can make up.
HOPELESS = 4
MAX_REPEATED = 20.0  # longest run that is repeated [s]
REFERENCE_TOLERANCE = 1e-10  # of the reference forces
COLUMNS = {
    "task": ("what is computed", ""),
    "hurst": ("Hurst exponent of the disc", "1"),
    "elements": ("elements across the disc", "1"),
    "levels": ("levels", "1"),
    "solver": ("solver", ""),
    "version": ("version of the solver", ""),
    "threads": ("threads", "1"),
    "tolerance": ("its loosest tolerance that meets the required residual, otherwise its best", "1"),
    "residual": ("largest residual of any level, from the pressures", "1"),
    "met": ("1 if the residual is within the one required", "1"),
    "force_error": ("largest relative error of the force at any level", "1"),
    "wall_s": ("wall time, median; empty if the residual is not met", "s"),
    "processor_s": ("processor time, median; empty if the residual is not met", "s"),
    "ratio": ("wall time over that of the path on as many threads, median of pairs run one after the other", "1"),
    "ratio_low": ("least ratio of a pair", "1"),
    "ratio_high": ("largest ratio of a pair", "1"),
    "iterations": ("iterations of another solver (-1 if not reported), operator applications of the path", "1"),
    "memory": ("peak memory of another solver's process; of the path, of its arrays", "byte"),
}


@dataclass(frozen=True)
class Task:
    """Depths of an indenter at which the contact is to be solved to a residual, by solvers with `threads` threads.

    hurst : Hurst exponent of the indenter; residual : largest |gap| in contact or overlap outside it, over the depth
    """

    name: str
    hurst: float
    indenter: Indenter
    depths: np.ndarray
    residual: float
    threads: tuple = (1,)

    def exact_forces(self):
        """F/G at the depths, for solvers at given force, and to compare forces with."""
        return indent(self.indenter, tolerance=REFERENCE_TOLERANCE, depths=self.depths).force

    def solve(self, threads):
        """What is timed: the solution of this package."""
        return indent(self.indenter, tolerance=self.residual, depths=self.depths, threads=threads)

    def outcome(self, solution):
        """Residual, force and total_iterations of that solution, by level; not timed."""
        applications = solution.operator_applications
        return SimpleNamespace(residual=solution.residual, force=solution.force, total_iterations=applications)


def time_other_solvers(*, seed, hursts, pairs, longest, tasks, peers):
    """`compare_solvers` on every task for every Hurst exponent, with the installed solvers.

    tasks : setting of that name; peers : {solver: [Python of its environment, its adapter]}
    longest : seconds after which a run of another solver is abandoned
    """
    common = {"pairs": pairs, "time_limit": longest}
    tables, installed = [], installed_solvers(peers)
    threadpool_limits(1)  # of linear algebra; Snakemake gives the job all cores, so that no other job runs
    for number, task in enumerate(tasks):
        fractions = np.geomspace(*task["fractions"], task["levels"]) if task["levels"] > 1 else task["fractions"][:1]
        for hurst in hursts:
            disc = {"seed": realization_seed(seed, *solver_race_key(number, hurst)), "threads": task["threads"]}
            levels = disc_task(task["name"], hurst, task["elements"], fractions, task["residual"], **disc)
            tables.append(compare_solvers(levels, installed, **common))
    return pd.concat(tables)


def installed_solvers(peers):
    """The OtherSolvers that are installed; a warning names those that are not."""
    solvers = [other_solvers.OtherSolver(name, *map(Path, paths)) for name, paths in peers.items()]
    for solver in solvers:
        if not solver.installed:
            logging.warning("%s is not installed and is omitted (make peers installs it)", solver.name)
    return [solver for solver in solvers if solver.installed]


def disc_task(name, hurst, elements, fractions, residual, *, seed, threads=(1,)):
    """A self-affine disc at the depths of the given contact fractions; elements : across the disc."""
    disc = self_affine_disc(hurst, elements, seed=seed)
    coarse = indent(disc, tolerance=1e-2, until_fraction=min(1.0, 1.2 * max(fractions)))
    depths = np.interp(fractions, coarse.contact_fraction, coarse.depth)
    return Task(name, hurst, disc, depths, residual, tuple(threads))


def compare_solvers(task, solvers, *, pairs, time_limit):
    """Time and residual of the path and of other solvers on one task, each with its loosest sufficient tolerance.

    pairs : number of pairs of runs, of the path and of another solver on as many threads, in alternating order; a
        solver that takes longer than MAX_REPEATED, or HOPELESS times as long as the fastest, runs in one pair only
    time_limit : seconds after which a run of another solver is abandoned

    Solutions that miss the residual are not timed. Returns a pandas.DataFrame with the columns of `COLUMNS`: the path
    on each number of threads, then one row per solver and number of threads.
    """
    exact = task.exact_forces()
    paths = {threads: partial(task.solve, threads) for threads in task.threads}
    rows = [_row_of_path(task, path, threads, exact) for threads, path in paths.items()]
    races, fastest = [], np.inf
    for solver in solvers:
        logging.info("%s, H = %g: %s, search for its tolerance", task.name, task.hurst, solver.name)
        ask = partial(other_solvers.solve, solver, task.indenter, task.depths, exact, time_limit=time_limit)
        tolerance, solution = _loosest_tolerance(ask, task.residual, fastest)
        if solution is None:
            continue
        met = solution.residual.max() <= task.residual
        fastest = min(fastest, solution.wall_s) if met else fastest
        for threads, path in paths.items():
            named = {"solver": solver.name, "version": solution.version, "threads": threads, "tolerance": tolerance}
            rows.append(_row(task, exact, solution, solution.memory) | named)
            if met:
                own_times = (solution.wall_s, solution.processor_s) if threads == 1 else None
                races.append(_Race(path, partial(ask, tolerance, threads=threads), own_times, rows[-1]))
    longest = min(MAX_REPEATED, HOPELESS * fastest)
    for number in range(pairs):
        logging.info("%s, H = %g: pair %d of %d", task.name, task.hurst, number + 1, pairs)
        for race in races:
            race.run_pair(path_first=number % 2 == 0, longest=longest)
    for race in races:
        race.record()
    for row, path in zip(rows, paths.values(), strict=False):
        seconds = [own for race in races if race.path is path for own, _ in race.seconds]
        while not seconds or (len(seconds) < pairs and sum(wall for wall, _ in seconds) < MAX_REPEATED):
            seconds.append(timing.timed(path)[1:])
        row["wall_s"], row["processor_s"] = np.median(seconds, axis=0)
        row |= dict.fromkeys(("ratio", "ratio_low", "ratio_high"), 1.0)
    return pd.DataFrame(rows, columns=list(COLUMNS))


@dataclass
class _Race:
    """Pairs of runs of the path and of another solver, and the row that records them.

    known : (wall, processor) seconds of an earlier run of the other solver with this tolerance, or None
    """

    path: partial
    other: partial
    known: tuple | None
    row: dict
    seconds: list = field(default_factory=list)

    def run_pair(self, *, path_first, longest):
        """Run one more pair; a solver that takes longer than `longest` seconds gets a single pair."""
        if self.seconds and not self.known[0] < longest:
            return
        own = timing.timed(self.path)[1:] if path_first else None
        if self.known is None or self.known[0] < longest:
            solution = self.other()
            self.known = (solution.wall_s, solution.processor_s) if solution else (np.nan, np.nan)
        self.seconds.append((own or timing.timed(self.path)[1:], self.known))

    def record(self):
        """Record median times and ratios; least and largest of n ratios enclose the median with 1 − 2^(1−n)."""
        own, other = np.moveaxis(np.array(self.seconds), 1, 0)
        ratios = other[:, 0] / own[:, 0]
        self.row["wall_s"], self.row["processor_s"] = np.median(other, axis=0)
        self.row["ratio"] = np.median(ratios)
        if ratios.size > 1:
            self.row["ratio_low"], self.row["ratio_high"] = ratios.min(), ratios.max()


def _row_of_path(task, path, threads, exact):
    solution, memory = timing.with_memory(path)
    named = {"solver": "viscorough", "version": __version__, "threads": threads, "tolerance": task.residual}
    return _row(task, exact, task.outcome(solution), memory) | named


def _row(task, exact, outcome, memory):
    """Task, accuracy and cost of an outcome; exact : forces of the levels."""
    residual = outcome.residual.max()
    return {
        "task": task.name,
        "hurst": task.hurst,
        "elements": len(task.indenter.heights),
        "levels": len(task.depths),
        "residual": residual,
        "met": int(residual <= task.residual),
        "force_error": np.abs(outcome.force / exact - 1).max(),
        "iterations": outcome.total_iterations,
        "memory": memory,
    }


def _loosest_tolerance(ask, required, fastest):
    """Loosest tolerance with which a solver meets the required residual, otherwise its best one, and the Solution.

    ask : returns the solver's Solution for a tolerance, None where it has none
    fastest : seconds of the fastest solver so far; one that takes HOPELESS times as long is not tried with looser ones
    Tolerance and Solution are None if no tolerance gave a solution.
    """
    solutions = {}

    def residual(i):
        solutions[i] = ask(TOLERANCE_RATIOS[i] * required)
        return np.inf if solutions[i] is None else solutions[i].residual.max()

    i = TOLERANCE_RATIOS.index(FIRST_RATIO)
    if residual(i) <= required:
        while i > 0 and solutions[i].wall_s < HOPELESS * fastest and residual(i - 1) <= required:
            i -= 1
    else:
        while i + 1 < len(TOLERANCE_RATIOS) and solutions[i] is not None:
            i += 1
            if residual(i) <= required:
                break
    residuals = {j: solution.residual.max() for j, solution in solutions.items() if solution is not None}
    if not residuals:
        return None, None
    best = min((j for j, value in residuals.items() if value <= required), default=min(residuals, key=residuals.get))
    return TOLERANCE_RATIOS[best] * required, solutions[best]
