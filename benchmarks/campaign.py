"""Count silent failures: random small indenters whose solution claims to have converged but is wrong.

    python benchmarks/campaign.py --output results/campaign.json

Solutions are compared with dense ones and with the direct integration in time. `make stability` runs it. A case is
reproduced from its number by random_case(case_generator(seed, case)).
"""

import json
import time
from importlib.metadata import version

import click
import numpy as np
from tqdm import tqdm

from viscorough.io.atomic import atomic_write
from viscorough_study.performance import timing
from viscorough_study.robustness.random_indenters import random_case, silent_failure
from viscorough_study.seeds import random_indenter_key, realization_seed


def case_generator(seed, case):
    """The random generator of one case, which does not depend on the other cases."""
    return np.random.default_rng(realization_seed(seed, *random_indenter_key(case)))


@click.command()
@click.option("--cases", type=click.IntRange(1), default=12_000, show_default=True, help="Number of indenters.")
@click.option("--seed", type=click.IntRange(0), default=2013, show_default=True, help="Root seed.")
@click.option("--output", required=True, help="File to write, JSON.")
def main(cases, seed, output):
    """Count silent failures; exit code 1 if there is any."""
    began, failures = time.perf_counter(), []
    for case in tqdm(range(cases), unit="indenter", mininterval=2):
        try:
            wrong = silent_failure(random_case(case_generator(seed, case)))
        except Exception as error:  # any exception counts as a failure of its case, and the campaign continues
            wrong = f"{type(error).__name__}: {error}"
        if wrong:
            failures.append({"case": case, "wrong": wrong})
            tqdm.write(f"case {case}: {wrong}")
    about = {"machine": timing.machine(), "version": version("viscorough"), "seed": seed, "cases": cases}
    result = about | {"seconds": round(time.perf_counter() - began, 1), "silent_failures": failures}
    with atomic_write(output) as temporary:
        temporary.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    click.echo(f"{output}: {len(failures)} silent failures among {cases} indenters in {result['seconds']} s")
    raise SystemExit(bool(failures))


if __name__ == "__main__":
    main()
