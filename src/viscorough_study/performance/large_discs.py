"""Cost of the loading curve of one disc on ever finer grids."""

import resource

from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough_study.performance import timing

COLUMNS = {
    "across": ("elements across the disc", "1"),
    "elements": ("elements of the disc", "1"),
    "levels": ("levels of its loading curve", "1"),
    "operator_applications": ("applications of the half-space operator", "1"),
    "wall": ("wall time", "s"),
    "processor": ("processor time", "s"),
    "memory": ("largest memory of the process", "byte"),
    "machine": ("machine on which times and memory were measured", None),
}


def measure_disc(hurst, elements, seed, *, tolerance, until_fraction, warm_up):
    """LoadingCurve of a disc of diameter and rms height 1, and what it cost, {column of `COLUMNS`: value}.

    elements, warm_up : across the disc, and across one that is indented before to load the compiled functions
    Memory is the largest that this process had at any time.
    """
    indent(self_affine_disc(hurst, warm_up, seed=0), tolerance=tolerance)
    disc = self_affine_disc(hurst, elements, seed=seed)
    curve, wall, processor = timing.timed(lambda: indent(disc, tolerance=tolerance, until_fraction=until_fraction))
    return curve, {
        "across": elements,
        "elements": disc.elements,
        "levels": curve.depth.size,
        "operator_applications": curve.operator_applications,
        "wall": wall,
        "processor": processor,
        "memory": 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
        "machine": "{name}, {processor}, {cores} cores".format(**timing.machine()),
    }
