"""Cost of the loading curve of one disc: time, operator applications and memory."""

import pandas as pd

from viscorough.io.atomic import atomic_write
from viscorough_study.performance.large_discs import measure_disc
from viscorough_study.run.job_log import run_job
from viscorough_study.run.seeds import large_disc_key, realization_seed


def main(csv, *, elements, seed, **options):
    """Measure a disc of `elements` elements across; options : further arguments of measure_disc."""
    cost = measure_disc(elements=elements, seed=realization_seed(seed, *large_disc_key(elements)), **options)
    with atomic_write(csv) as temporary:
        pd.DataFrame([cost]).to_csv(temporary, index=False)


run_job(
    globals(), lambda job: main(**job.output, elements=int(job.wildcards.elements), threads=job.threads, **job.params)
)
