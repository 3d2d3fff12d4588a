"""Cost and error of every method on one indenter."""

from threadpoolctl import threadpool_limits

from viscorough.io.atomic import atomic_write
from viscorough_study.performance.measurement import measure
from viscorough_study.performance.problems import named_problem
from viscorough_study.run.job_log import log_to
from viscorough_study.run.kernels import compile_kernels


def main(csv, *, problem, seed, levels, repeats, longest):
    """Measure all methods on a problem given by its settings."""
    compile_kernels()  # so that loading compiled code is not timed
    with threadpool_limits(1):  # Snakemake gives the job all cores, so that no other job runs
        indenter = named_problem(**problem, levels=levels, root=seed)
        table = measure(indenter, repeats, longest=longest)
    with atomic_write(csv) as temporary:
        table.to_csv(temporary, index=False)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
