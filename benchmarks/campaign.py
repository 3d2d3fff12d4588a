"""Generated small indenters against dense solutions: what claims to have converged and is wrong is counted.

`make stability` runs it; the numbers of a case give it again: generated.generated_case(case_generator(seed, case)).
"""

import json
import time
from importlib.metadata import version

import click
import numpy as np
from tqdm import tqdm

from viscorough.io.atomic import atomic_write
from viscorough_study.performance import timing
from viscorough_study.robustness.random_indenters import generated_case, silent_failure
from viscorough_study.seeds import random_indenter_key, realization_seed


def case_generator(seed, case):
    """The generator of one case, whatever cases are run beside it."""
    return np.random.default_rng(realization_seed(seed, *random_indenter_key(case)))


@click.command()
@click.option("--cases", default=12_000, show_default=True, help="Number of indenters.")
@click.option("--seed", default=2013, show_default=True)
@click.option("--output", required=True, help="JSON file to write.")
def main(cases, seed, output):
    """Count silent failures; exit code 1 if there is any."""
    began, failures = time.perf_counter(), []
    for case in tqdm(range(cases), unit="indenter", mininterval=2):
        try:
            wrong = silent_failure(*generated_case(case_generator(seed, case)))
        except Exception as error:  # whatever it is, it is a failure with its case, and the campaign goes on
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
