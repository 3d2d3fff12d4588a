"""Count silent failures: random small indenters whose solution is reported as converged but is wrong.

    python benchmarks/campaign.py --output results/campaign.json

Most families of cases are checked against direct integration in time: levels at given depths, also against the dense
influence matrix; whole loading curves, at their levels and between them; curves with a start fraction; and levels at
given forces, also with the methods for large maps. Whole curves of ordinary discs are checked by the depth of complete
contact: 257 elements across at a tolerance of 1e-2, and 65 or 129 across at random tolerances from 1e-1 to 1e-5. `make
stability` runs it. A failure is printed with the command that repeats it.
"""

from dataclasses import replace
from functools import partial
from multiprocessing import Pool
from pathlib import Path
from unittest.mock import patch

import click
import numpy as np
from measuring import save
from random_curves import (
    curve_failure,
    levels_failure,
    random_curve,
    random_levels,
    random_whole_curve,
    whole_curve_failure,
)
from tqdm import tqdm

from viscorough.contact.halfspace import tiles
from viscorough_study.run.seeds import random_indenter_key, realization_seed


def as_on_large_maps(case):
    """Check the curve of a case with tiled operators, estimates from blocks and few ranked elements."""
    options = replace(
        case.arguments["options"],
        rank_first=50,
        rank_all_for_curves=50,
        blocks_from=1,
        blocks_in_contact=1,
        tiles_from=0,
        tiles_share=1.0,
    )
    with patch.object(tiles, "SIDE", 8):
        return curve_failure(replace(case, arguments=case.arguments | {"options": options}))


# {family: (function that draws a case, function that checks it, fraction of the number of cases)}
FAMILIES = {
    "levels": (random_levels, levels_failure, 1.0),
    "curves": (random_curve, curve_failure, 1.0),
    "starts": (partial(random_curve, with_start=True), curve_failure, 0.1),
    "forces": (partial(random_curve, at_forces=True), curve_failure, 1.0),
    "large_maps": (partial(random_curve, at_forces=True), as_on_large_maps, 1.0),
    "whole_discs": (partial(random_whole_curve, across=[257]), whole_curve_failure, 5 / 12),
    "whole_tolerances": (
        partial(random_whole_curve, across=[65, 129], largest_tolerance=1e-1, smallest_tolerance=1e-5),
        whole_curve_failure,
        5 / 12,
    ),
}


def failure(family, seed, case):
    """Return the failure of one case of a family, "" if there is none. Any exception counts as a failure."""
    draw, check, _ = FAMILIES[family]
    generator = np.random.default_rng(realization_seed(seed, *random_indenter_key(case)))
    try:
        return check(draw(generator))
    except Exception as error:
        return f"{type(error).__name__}: {error}"


@click.command()
@click.option("--cases", type=click.IntRange(1), default=12_000, show_default=True, help="Cases of levels and curves.")
@click.option("--seed", type=click.IntRange(0), default=2013, show_default=True, help="Root seed.")
@click.option("--family", type=click.Choice(list(FAMILIES)), help="Only this family.")
@click.option("--case", type=click.IntRange(0), help="Only the case of this number.")
@click.option("--cores", type=click.IntRange(1), default=1, show_default=True, help="Processes.")
@click.option("--output", type=click.Path(path_type=Path), help="File to write, JSON.")
def main(cases, seed, family, case, cores, output):
    """Count silent failures; the exit code is 1 if there is any."""
    counts, failures = {}, []
    for name in [family] if family else FAMILIES:
        numbers = [case] if case is not None else range(max(1, round(FAMILIES[name][2] * cases)))
        counts[name] = len(numbers)
        with Pool(cores) as pool:
            wrongs = pool.imap(partial(failure, name, seed), numbers)
            for number, wrong in tqdm(zip(numbers, wrongs, strict=True), name, len(numbers), mininterval=2):
                if wrong:
                    failures.append({"family": name, "case": number, "wrong": wrong})
                    repeat = f"python benchmarks/campaign.py --family {name} --case {number} --seed {seed}"
                    tqdm.write(f"{wrong}\n    {repeat}")
    click.echo(f"{len(failures)} silent failures among {sum(counts.values())} cases")
    if output:
        save({"seed": seed, "cases": counts, "silent_failures": failures}, output)
    raise SystemExit(bool(failures))


if __name__ == "__main__":
    main()
