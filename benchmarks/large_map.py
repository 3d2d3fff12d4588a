"""Measure what a large measured-like map costs on one thread and on several: its curve, and the contact at a force.

    python benchmarks/large_map.py --output results/large_map.json

The map is a self-affine square with H = 0.8 and no roll-off, of 2049 points across. Two processes of their own compute
the curve from first touch to a contact fraction of 50 %, and the contact at one force with about 10 % in contact. Each
has compiled everything before, on a small map. The file has the wall and processor seconds and the peak of the
process's memory, the map, the interpreter and libraries included.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import click
import numpy as np

from viscorough import Indenter, contact_at, indent, self_affine_disc
from viscorough.surfaces import self_affine_square
from viscorough_study.performance import timing
from viscorough_study.tables import write_json

HURST, SEED, TOLERANCE = 0.8, 1, 1e-3
# F/G over rms height and side of the map, at which about 10 % are in contact.
FORCE = 9.0
UNTIL_FRACTION = 0.5


def curve(surface, threads):
    """The loading curve to the contact fraction."""
    result = indent(surface, tolerance=TOLERANCE, until_fraction=UNTIL_FRACTION, threads=threads)
    return {
        "levels": len(result.depth),
        "operator_applications": result.operator_applications,
        "contact_fraction": float(result.contact_fraction[-1]),
    }


def contact(surface, threads):
    """The contact at the force."""
    result = contact_at(surface, force=FORCE, tolerance=TOLERANCE, threads=threads)
    balance = np.nansum(result.pressure) * result.spacing * result.row_spacing / result.force - 1
    return {
        "contact_fraction": result.contact_fraction,
        "patches": len(result.patches().areas),
        "residual": result.residual,
        "force_balance": float(balance),
    }


QUESTIONS = {"curve": curve, "contact": contact}


def measure(question, heights, threads):
    """Print the cost of one question as JSON; in a separate process."""
    QUESTIONS[question](self_affine_disc(HURST, 129, seed=SEED), threads)
    surface = np.load(heights)
    surface = Indenter(surface, 1 / len(surface))
    result, wall, processor = timing.timed(lambda: QUESTIONS[question](surface, threads))
    peak = 1024 * int(re.search(r"VmHWM:\s*(\d+) kB", Path("/proc/self/status").read_text())[1])
    print(json.dumps({"wall_s": wall, "processor_s": processor, "peak_bytes": peak, **result}))


@click.command()
@click.option("--points", type=click.IntRange(9), default=2049, show_default=True, help="Points across the map.")
@click.option("--threads", type=click.IntRange(2), default=2, show_default=True, help="Compared with one thread.")
@click.option("--output", required=True, help="File to write, JSON.")
def main(points, threads, output):
    """Measure what a large measured-like map costs."""
    rows = {"machine": timing.machine(), "points": points, "tolerance": TOLERANCE, "threads": threads}
    limits = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
    with tempfile.TemporaryDirectory() as folder:
        heights = Path(folder) / "heights.npy"
        np.save(heights, self_affine_square(HURST, points, seed=SEED))
        for question, number in [(question, number) for question in QUESTIONS for number in (1, threads)]:
            code = f"import large_map; large_map.measure({question!r}, {str(heights)!r}, {number})"
            environment = os.environ | limits | {"PYTHONPATH": str(Path(__file__).parent)}
            done = subprocess.run(
                [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False
            )
            if done.returncode:
                raise click.ClickException(f"{question}: {done.stderr.strip()}")
            row = json.loads(done.stdout)
            rows[question if number == 1 else f"{question}_threads"] = row
            text = "{wall_s:.1f} s, {processor_s:.1f} s of processor time".format(**row)
            click.echo(f"{question}, threads {number}: {text}, {row['peak_bytes'] / 1e9:.2f} GB")
    write_json(rows, output)


if __name__ == "__main__":
    main()
