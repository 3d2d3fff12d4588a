"""Compile all numba functions before jobs run side by side.

    python -m viscorough_study.run.kernels

Without this step, jobs that start at the same time would all compile the same functions.
"""

import multiprocessing
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from viscorough.basics.compiled_code import code_folder

_STAMP = ".snakemake/kernels"


def _small_disc():
    """Compute a curve with the parts of the solver that small grids use."""
    from viscorough.contact.loading_path import indent
    from viscorough.surfaces.self_affine import self_affine_disc

    indent(self_affine_disc(0.6, 65, seed=0))


def _large_disc():
    """Compute a curve on a grid that is large enough for all kernels of the solver to be called."""
    from viscorough.contact.loading_path import indent
    from viscorough.surfaces.self_affine import self_affine_disc

    indent(self_affine_disc(0.6, 129, seed=0))


def _lines_and_columns():
    """Reduce lines of both precisions, and transform the columns of a grid."""
    from viscorough.contact.halfspace.operator import Halfspace
    from viscorough.mdr import reduce_heights
    from viscorough.surfaces.lines import SelfAffineLines

    Halfspace(129, 129, np.float32).apply()
    for dtype in ("f4", "f8"):
        lines = SelfAffineLines(0.6, 256, dtype=dtype)
        reduce_heights(lines.heights_in_any_order(0), lines.spacing)


def _events():
    """Integrate the contact events of a disc."""
    from viscorough.surfaces.self_affine import self_affine_disc
    from viscorough.viscous.integration.events import newtonian_events

    newtonian_events(self_affine_disc(0.6, 17, seed=0))


def _exact_contacts():
    """Solve contacts to a small tolerance and in double precision, and a contact at a given depth."""
    from viscorough.contact.loading_path import indent
    from viscorough.contact.one_contact import contact_at
    from viscorough.contact.options import SolverOptions
    from viscorough.surfaces.self_affine import self_affine_disc

    disc = self_affine_disc(0.6, 129, seed=0)
    contact_at(disc, depth=0.5)
    indent(disc, depths=[0.5, 1.0, 2.0], tolerance=1e-10)
    double = SolverOptions(dense_contacts=0, dense_interactions=0, precision="double", exact_gap_below=0.0)
    indent(disc, depths=[0.5, 1.0, 2.0], tolerance=1e-6, options=double)


def _motion():
    """Compute the motion of a row of springs."""
    from viscorough.contact.loading_path import indent
    from viscorough.surfaces.self_affine import self_affine_disc
    from viscorough.viscous.kinetics import kinetics

    curve = indent(self_affine_disc(0.6, 17, seed=0))
    kinetics(curve, curve.force[-1], 1.0, [0.1, 0.5])


# Calls that compile all functions of the default run. The two calls of a pair compile different functions. Later pairs
# also use functions that earlier pairs have compiled.
_CALLS = (_small_disc, _lines_and_columns), (_large_disc, _events), (_exact_contacts, _motion)


def compile_kernels():
    """Compile the numba functions of the default run by calling them, or load them if they are compiled already."""
    for pair in _CALLS:
        for call in pair:
            call()


def compile_in_two_processes():
    """Compile the functions of `compile_kernels` and store them, with two processes at a time.

    numba compiles only one function at a time in a process. The compilers take a fifth more processor time than in a
    single process, because both processes load numba and compile its functions.
    """
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as processes:
        for pair in _CALLS:
            for compilation in [processes.submit(call) for call in pair]:
                compilation.result()


def compile_once(digest):
    """Compile all functions in another process, unless an earlier run in this folder has compiled the same source code.

    The functions are also compiled again if numba has another version, or if the folder of the compiled code was
    removed. Otherwise all jobs that run side by side would compile them.

    digest : digest of the source code of the functions, which is stored with the name of the folder of their code

    There is no Snakemake rule for the compilation, because many jobs would need its output as an input. All these jobs
    would be rerun whenever this output is remade. If the input were marked as `ancient`, Snakemake would not notice
    changed parameters of these jobs.
    """
    stamp, compiled = Path(_STAMP), f"{digest}\n{code_folder()}\n"
    if stamp.is_file() and stamp.read_text() == compiled and any(code_folder().rglob("*.nbi")):
        return
    print("Compiling the solvers, once: about 30 seconds", file=sys.stderr, flush=True)
    subprocess.run([sys.executable, "-m", "viscorough_study.run.kernels"], check=True)
    stamp.write_text(compiled)


if __name__ == "__main__":
    compile_in_two_processes()
