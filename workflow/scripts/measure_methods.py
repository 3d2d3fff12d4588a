"""Cost and error of every method on one indenter."""

from pathlib import Path

from threadpoolctl import threadpool_limits

from viscorough.io.atomic import atomic_write
from viscorough_study.performance.measurement import measure
from viscorough_study.performance.methods import METHODS, other_solver_method
from viscorough_study.performance.other_solvers import OtherSolver
from viscorough_study.performance.problems import named_problem
from viscorough_study.run.job_log import log_to
from viscorough_study.run.kernels import compile_kernels


def main(csv, *, problem, groups, seed, levels, repeats, longest, peers):
    """Measure methods of the package, and the installed other solvers, on a problem given by its settings."""
    solvers = [OtherSolver(name, *map(Path, paths)) for name, paths in peers.items()]
    methods = (*METHODS, *(other_solver_method(solver, longest) for solver in solvers if solver.installed))
    methods = [method for method in methods if method.group in groups]
    compile_kernels()  # so that loading compiled code is not timed
    with threadpool_limits(1):  # Snakemake gives the job all cores, so that no other job runs
        indenter = named_problem(**problem, levels=levels, root=seed)
        table = measure(indenter, repeats, methods, longest=longest)
    with atomic_write(csv) as temporary:
        table.to_csv(temporary, index=False)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
