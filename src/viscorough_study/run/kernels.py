"""Compile all numba functions before jobs run side by side.

    python -m viscorough_study.run.kernels

Without this step, jobs that start at the same time would all compile the same functions.
"""

import subprocess
import sys
import time
from pathlib import Path

from viscorough.io.atomic import atomic_write

# File with the time of the compilation, in the format of Snakemake's benchmark files of jobs.
KERNELS_BENCHMARK = "results/benchmarks/compile_kernels.tsv"
_STAMP = ".snakemake/kernels"


def compile_kernels():
    """Compile the numba functions of the loading path, of the lines and of the direct integration, by calling them.

    The disc of the loading path is large enough for all kernels of the solver to be called.
    """
    from viscorough.contact.loading_path import indent
    from viscorough.mdr import reduce_heights
    from viscorough.surfaces.lines import SelfAffineLines
    from viscorough.surfaces.self_affine import self_affine_disc
    from viscorough.viscous.integration.events import march_events

    indent(self_affine_disc(0.6, 129, seed=0))
    march_events(self_affine_disc(0.6, 17, seed=0))
    for dtype in ("f4", "f8"):
        lines = SelfAffineLines(0.6, 256, dtype=dtype)
        reduce_heights(lines.heights_in_any_order(0), lines.spacing)


def compile_once(digest):
    """Compile all functions in another process, unless an earlier run in this folder has compiled the same source code.

    digest : digest of the source code of the functions, which is stored in the folder

    There is no Snakemake rule for the compilation, because many jobs would need its output as an input. All these jobs
    would be rerun whenever this output is remade. If the input were marked as `ancient`, Snakemake would not notice
    changed parameters of these jobs.
    """
    stamp = Path(_STAMP)
    if stamp.is_file() and stamp.read_text() == digest:
        return
    print("Compiling the solvers, once: about 20 seconds", file=sys.stderr, flush=True)
    start = time.monotonic()
    subprocess.run([sys.executable, "-m", "viscorough_study.run.kernels"], check=True)
    cost = Path(KERNELS_BENCHMARK)
    cost.parent.mkdir(parents=True, exist_ok=True)
    with atomic_write(cost) as temporary:
        # The column of the memory is empty, since the memory is not measured.
        temporary.write_text(f"s\tmax_rss\n{time.monotonic() - start:.2f}\t\n")
    stamp.write_text(digest)


if __name__ == "__main__":
    compile_kernels()
