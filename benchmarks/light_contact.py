"""Time a light load on square maps like scans, by the size of the map, and compare other solvers.

    python benchmarks/light_contact.py --output results/light_contact.csv --figure results/light_contact.png

The whole map is read, and pressure and gap are computed everywhere. Every solver needs at least the time to read the
map and to rank the elements that can touch. Solvers that `make peers` has not installed are left out. The table has the
columns of COLUMNS; a NetCDF file next to it also records settings and machine. `make light` runs it.
"""

from functools import partial
from pathlib import Path

import click
import numpy as np
import other_solvers
import pandas as pd
import solver_race
from measuring import LARGE_PAGES, fit_cost, output_option, run_timed, save_times

from viscorough import Indenter, contact_at
from viscorough.contact.ranking import Ranking
from viscorough.surfaces.self_affine import self_affine_square
from viscorough_study.figures import style
from viscorough_study.performance import timing
from viscorough_study.run.seeds import light_map_key, realization_seed

# Elements across the maps, one map of each size, and contact fractions for which the loads are chosen.
ELEMENTS, FRACTIONS = (256, 512, 1024, 2048, 4096, 8192), (5e-4, 5e-3)
# Maps and loads for the comparison: solvers or their modes, maps, and contact fractions of the loads.
SOLVERS = ("Tamaas", "ContactMechanics", "ASPHER active set")
RACE_ELEMENTS, RACE_FRACTIONS = (2048, 4096), (5e-4, 5e-3, 0.025, 0.3)
# Exponent of the maps, residual to be reached, root seed, pairs of runs of this solver and another, their threads.
HURST, RESIDUAL, SEED, PAIRS, THREADS = 0.8, 3e-5, 2013, 3, (1, 2)
# Other solvers are stopped after this many times our time, or after the shortest time.
SLOWER, SHORTEST = 20, 2.0  # [s]
# Largest number of repetitions of our solutions; a small map is repeated until SHORTEST has passed.
MOST_REPEATS = 40
# Corrections of the force towards a contact fraction, and the tolerance of the contacts used for them.
CORRECTIONS, TOLERANCE = 3, 1e-2
COLUMNS = {
    "fraction": ("contact fraction that the load was chosen for", "1"),
    **{name: text for name, text in solver_race.COLUMNS.items() if name not in ("task", "levels", "force_error")},
    "over_depth": ("time of our solution on one thread over that at the depth instead, run in turn, of medians", "1"),
    "ranking_s": ("time of reading the map and ranking the elements that can touch, median", "s"),
}


class LightLoad(solver_race.Task):
    """A load on a map, the only one of `forces`; depths : depth of the contact, shape (1,)"""

    def solve(self, threads):
        """Return the Contact under the load, with its maps."""
        return contact_at(self.indenter, force=self.forces[0], tolerance=self.residual, threads=threads)

    def rank(self):
        """Rank the elements that can touch, the least that any solution needs."""
        return Ranking(self.indenter, largest_depth=self.depths[0]).elements

    def outcome(self, solution):
        """Return residual, by the measure of all solvers, and force; the number of iterations is not reported."""
        gap = self.indenter.initial_gap / self.indenter.spacing
        residual = other_solvers.contact_residual(gap, np.nan_to_num(solution.pressure))
        return np.array([residual]), np.array([solution.force]), -1


def light_load(indenter, fraction):
    """Return the LightLoad for a contact fraction, which is almost proportional to the force.

    The first guess is the law of light contact between rough surfaces, F = ½ E* h′ A with E* = 4G, contact area A and
    rms slope h′ (Persson 2001, Hyun et al. 2004).
    """
    force = 2 * indenter.rms_slope * fraction * indenter.elements * indenter.spacing**2
    for _ in range(CORRECTIONS):
        contact = contact_at(indenter, force=force, tolerance=TOLERANCE)
        force *= fraction / contact.contact_fraction
    depth = contact_at(indenter, force=force, tolerance=TOLERANCE).depth
    name = f"{100 * fraction:g} % at {len(indenter.heights)}"
    return LightLoad(name, HURST, indenter, np.array([depth]), np.array([force]), RESIDUAL, THREADS)


@style.figure
def plot_light_contact(table):
    """Plot wall time on one thread against the elements of the map, with the time of ranking them.

    table : with the columns of `COLUMNS`
    Exponents are fitted to the larger half of the sizes.
    """
    own = table.query("solver == 'viscorough' and threads == 1 and met == 1 and fraction in @FRACTIONS")
    own = own.assign(number=own["elements"] ** 2.0)
    looks = style.series_looks(own["fraction"].unique())
    figure = style.new_figure(85, style.NARROW)
    axes = figure.subplots()
    for fraction, rows in own.groupby("fraction"):
        larger = rows[min(len(rows) // 2, len(rows) - 2) :]
        exponent, _ = fit_cost(larger["number"], larger["wall_s"])
        label = f"contact of {100 * fraction:g} %, $N^{{{exponent:.2f}}}$"
        axes.plot(rows["number"], rows["wall_s"], **looks[fraction], label=label)
    ranking = own.groupby("number")["ranking_s"].min()
    axes.plot(ranking.index, ranking, "--", color=style.GREY, label="reading and ranking the map")
    axes.set(xscale="log", yscale="log", xlabel="elements of the map", ylabel="wall time (s)")
    figure.legend(loc="outside lower center")
    return figure


@click.command(help=__doc__.splitlines()[0])
@output_option
@click.option("--figure", type=click.Path(path_type=Path), required=True, help="PNG file to draw; also as PDF.")
def main(output, figure):
    solvers, stopped, tables = other_solvers.installed(SOLVERS), set(), []
    for across in ELEMENTS:
        seed = realization_seed(SEED, *light_map_key(HURST, across, 0))
        indenter = Indenter(self_affine_square(HURST, across, seed=seed), 1.0)
        raced = RACE_FRACTIONS if across in RACE_ELEMENTS else ()
        for fraction in sorted({*FRACTIONS, *raced}):
            click.echo(f"{across} x {across} elements, contact of {fraction:g}")
            load = light_load(indenter, fraction)
            _, seconds, _ = timing.timed(partial(load.solve, 1))
            names = [name for name in solvers if fraction in raced and (name, fraction) not in stopped]
            racing, limit = {name: solvers[name] for name in names}, max(SHORTEST, SLOWER * seconds)
            table = solver_race.compare_solvers(load, racing, pairs=PAIRS, time_limit=limit)
            # A solver that did not finish is not tried on a larger map.
            stopped |= {(name, fraction) for name in racing if name not in set(table["solver"])}
            at_depth = partial(contact_at, indenter, depth=load.depths[0], tolerance=RESIDUAL)
            own = {"force": partial(load.solve, 1), "depth": at_depth, "ranking": load.rank}
            times = timing.interleaved(own, max(PAIRS, min(MOST_REPEATS, int(SHORTEST / seconds))))
            force, depth, ranking = (times[name][0] for name in own)
            tables.append(table.assign(fraction=fraction, over_depth=force / depth, ranking_s=ranking))
    table = pd.concat(tables, ignore_index=True)[list(COLUMNS)]
    maps = {"elements": ELEMENTS, "fractions": FRACTIONS, "race": [RACE_ELEMENTS, RACE_FRACTIONS]}
    settings = {"hurst": HURST, "residual": RESIDUAL, "seed": SEED, "pairs": PAIRS, "threads": THREADS, **maps}
    save_times(table, output, COLUMNS, "One light load on large maps", settings)
    figure.parent.mkdir(parents=True, exist_ok=True)
    style.save_figure(plot_light_contact(table), figure, figure.with_suffix(".pdf"))
    click.echo(f"drawn in {figure}")


if __name__ == "__main__":
    run_timed(main, **LARGE_PAGES)
