"""Compare the elastic loading path with other solvers: the same levels of one indenter, to the same residual.

    python benchmarks/solver_race.py --output results/tables/other_solvers.csv

The time of the path includes its set-up and the exact stiffness at every level; the time of another solver includes
neither. Other solvers start every level from the previous level, if they can. Solvers that `make peers` has not
installed are left out. The table has the columns of COLUMNS; its first line also records settings and machine. `make
speed` runs it.
"""

import gc
import tracemalloc
from dataclasses import dataclass
from functools import partial

import click
import numpy as np
import other_solvers
import pandas as pd
from measuring import LARGE_PAGES, output_option, run_timed, save_times

from viscorough import Indenter, __version__, indent, self_affine_disc
from viscorough_study.performance import timing
from viscorough_study.run.seeds import realization_seed, solver_race_key

# Exponents of the discs, residual to be reached, root seed, pairs of runs of the path and another solver.
HURST, RESIDUAL, SEED, PAIRS = (0.4, 0.8), 1e-6, 2013, 5
LONGEST = 60.0  # seconds after which a run of another solver is abandoned
# {task: elements across the disc, levels, contact fractions of the first and the last level, threads}
TASKS = {
    "eight levels": (257, 8, (0.001, 0.5), (1,)),
    "thirty levels": (257, 30, (0.001, 0.5), (1,)),
    "one level at 1025": (1025, 1, (0.025, 0.025), (1, 2)),
    "one level at 2049": (2049, 1, (0.025, 0.025), (1, 2)),
}

# Tolerances of other solvers over the required residual, from loose to tight. Each solver measures its tolerance
# differently.
TOLERANCE_RATIOS = (30, 10, 3, 1, 1 / 3, 1 / 10, 1 / 30, 1 / 100)
HOPELESS = 4  # time over the fastest other solver that noise of the machine cannot explain
MAX_REPEATED = 20.0  # longest run that is repeated [s]
REFERENCE_TOLERANCE = 1e-10  # tolerance of the reference forces
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
    forces : F/G at the depths, for solvers at given force, and to compare forces with
    """

    name: str
    hurst: float
    indenter: Indenter
    depths: np.ndarray
    forces: np.ndarray
    residual: float
    threads: tuple = (1,)

    def solve(self, threads):
        """Solve the task with this package; this is timed."""
        return indent(self.indenter, tolerance=self.residual, depths=self.depths, threads=threads)

    def outcome(self, solution):
        """Return residual and force of this solution by level, and iterations; this is not timed."""
        return solution.residual, solution.force, solution.operator_applications


def disc_task(name, hurst, elements, fractions, threads, seed):
    """Return a self-affine disc at the depths of the given contact fractions; elements : number across the disc"""
    disc = self_affine_disc(hurst, elements, seed=seed)
    coarse = indent(disc, tolerance=1e-2, until_fraction=min(1.0, 1.2 * max(fractions)))
    depths = np.interp(fractions, coarse.contact_fraction, coarse.depth)
    forces = indent(disc, tolerance=REFERENCE_TOLERANCE, depths=depths).force
    return Task(name, hurst, disc, depths, forces, RESIDUAL, threads)


def compare_solvers(task, solvers, *, pairs, time_limit):
    """Measure time and residual of the path and of other solvers on one task.

    Every solver uses its loosest sufficient tolerance.

    solvers : {name: command}
    pairs : number of pairs of runs, of the path and of another solver on as many threads, in alternating order; a
        solver that takes longer than MAX_REPEATED, or HOPELESS times as long as the fastest before it, gets one pair
    time_limit : seconds after which a run of another solver is abandoned

    Solutions that miss the residual are not timed. Returns a pandas.DataFrame with the columns of `COLUMNS`: the path
    on each number of threads, then one row per solver and number of threads.
    """
    paths = {threads: partial(task.solve, threads) for threads in task.threads}
    own_rows, own_times, rows, fastest = [], {threads: [] for threads in paths}, [], np.inf
    for threads, path in paths.items():
        solution, memory = _with_memory(path)
        named = {"solver": "viscorough", "version": __version__, "threads": threads, "tolerance": task.residual}
        own_rows.append(_row(task, *task.outcome(solution), memory) | named)
    for solver in solvers.items():
        name, _ = solver
        click.echo(f"{task.name}, H = {task.hurst:g}: {name}")
        levels = task.indenter, task.depths, task.forces
        ask = partial(other_solvers.solve, solver, *levels, time_limit=time_limit)
        tolerance, solution = _loosest_tolerance(ask, task.residual)
        if solution is None:
            continue
        met = solution.residual.max() <= task.residual
        fastest = min(fastest, solution.wall_s) if met else fastest
        number = pairs if solution.wall_s < min(MAX_REPEATED, HOPELESS * fastest) else 1
        for threads, path in paths.items():
            named = {"solver": name, "version": solution.version, "threads": threads, "tolerance": tolerance}
            outcome = solution.residual, solution.force, solution.iterations, solution.memory
            rows.append(_row(task, *outcome) | named)
            if met:
                own, other = _race(path, partial(ask, tolerance, threads=threads), number)
                rows[-1] |= _times(other) | _ratios(other[:, 0] / own[:, 0])
                own_times[threads] += own.tolist()
    for row, seconds in zip(own_rows, own_times.values(), strict=True):
        while not seconds or (len(seconds) < pairs and sum(wall for wall, _ in seconds) < MAX_REPEATED):
            seconds.append(timing.timed(paths[row["threads"]])[1:])
        row |= _times(seconds) | dict.fromkeys(("ratio", "ratio_low", "ratio_high"), 1.0)
    return pd.DataFrame(own_rows + rows, columns=list(COLUMNS))


def _race(path, other, pairs):
    """Return (wall, processor) seconds of the path and of another solver, each of shape (pairs, 2), run in turn."""
    seconds = []
    for number in range(pairs):
        before = timing.timed(path)[1:] if number % 2 == 0 else None
        solution = other()
        times = (solution.wall_s, solution.processor_s) if solution else (np.nan, np.nan)
        seconds.append((before or timing.timed(path)[1:], times))
    return np.moveaxis(np.array(seconds), 1, 0)


def _times(seconds):
    return dict(zip(("wall_s", "processor_s"), np.median(seconds, axis=0), strict=True))


def _ratios(ratios):
    """Return the median of the ratios of n pairs; the extremes enclose the median with probability 1 − 2^(1−n)."""
    ends = {"ratio_low": ratios.min(), "ratio_high": ratios.max()} if ratios.size > 1 else {}
    return {"ratio": np.median(ratios)} | ends


def _row(task, residual, force, iterations, memory):
    """Return a row with task, accuracy and cost of a solution; residual, force : one value per level"""
    residual = residual.max()
    return {
        "task": task.name,
        "hurst": task.hurst,
        "elements": len(task.indenter.heights),
        "levels": len(task.depths),
        "residual": residual,
        "met": int(residual <= task.residual),
        "force_error": np.abs(force / task.forces - 1).max(),
        "iterations": iterations,
        "memory": memory,
    }


def _with_memory(function):
    """Return the result of a function, and the peak memory of its arrays [bytes]."""
    gc.collect()
    tracemalloc.start()
    try:
        return function(), tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def _loosest_tolerance(ask, required):
    """Return the loosest tolerance that meets the required residual, otherwise the best one, and the solution.

    ask : function that returns the solver's solution for a tolerance, None if it has none; tighter tolerances are then
        not tried
    Tolerance and solution are None if no tolerance gave a solution.
    """
    best, least = (None, None), np.inf
    for ratio in TOLERANCE_RATIOS:
        if (solution := ask(ratio * required)) is None:
            break
        if (residual := solution.residual.max()) < least:
            best, least = (ratio * required, solution), residual
        if residual <= required:
            break
    return best


@click.command(help=__doc__.splitlines()[0])
@output_option
def main(output):
    solvers, tables = other_solvers.installed(other_solvers.ADAPTERS), []
    for number, (name, (elements, levels, ends, threads)) in enumerate(TASKS.items()):
        for hurst in HURST:
            seed = realization_seed(SEED, *solver_race_key(number, hurst))
            task = disc_task(name, hurst, elements, np.geomspace(*ends, levels), threads, seed)
            tables.append(compare_solvers(task, solvers, pairs=PAIRS, time_limit=LONGEST))
    settings = {"hurst": HURST, "residual": RESIDUAL, "seed": SEED, "pairs": PAIRS, "longest": LONGEST, "tasks": TASKS}
    save_times(pd.concat(tables), output, COLUMNS, "Comparison with other solvers", settings)


if __name__ == "__main__":
    run_timed(main, **LARGE_PAGES)
