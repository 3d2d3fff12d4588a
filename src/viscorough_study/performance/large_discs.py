"""Cost of the loading curve of one disc on ever finer grids."""

import resource
from functools import partial

from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough_study.performance import timing

COLUMNS = {
    "across": ("elements across the disc", "1"),
    "elements": ("elements of the disc", "1"),
    "levels": ("levels of its loading curve", "1"),
    "operator_applications": ("applications of the half-space operator", "1"),
    "wall": ("wall time on one thread", "s"),
    "processor": ("processor time on one thread", "s"),
    "threads": ("threads of a second run", "1"),
    "wall_threads": ("its wall time", "s"),
    "memory": ("largest memory of the process", "byte"),
    "machine": ("machine on which times and memory were measured", None),
}


def measure_disc(hurst, elements, seed, *, tolerance, until_fraction, warm_up, threads):
    """LoadingCurve of a disc of diameter and rms height 1, and what it cost, {column of `COLUMNS`: value}.

    elements, warm_up : across the disc, and across one that is indented before to load the compiled functions
    threads : of a second run
    Memory is the largest that this process had at any time.
    """
    indent(self_affine_disc(hurst, warm_up, seed=0), tolerance=tolerance)
    disc = self_affine_disc(hurst, elements, seed=seed)
    press = partial(indent, disc, tolerance=tolerance, until_fraction=until_fraction)
    curve, wall, processor = timing.timed(press)
    _, wall_threads, _ = timing.timed(partial(press, threads=threads))
    return curve, {
        "across": elements,
        "elements": disc.elements,
        "levels": curve.depth.size,
        "operator_applications": curve.operator_applications,
        "wall": wall,
        "processor": processor,
        "threads": threads,
        "wall_threads": wall_threads,
        "memory": 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
        "machine": "{name}, {processor}, {cores} cores".format(**timing.machine()),
    }
