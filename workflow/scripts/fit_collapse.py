"""Collapse of the curves of all grids, exponents of an infinitely fine grid, and the grids that an exponent needs."""

import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study import infinite_grid, scaling_collapse
from viscorough_study.job_log import log_to
from viscorough_study.tables import write_table

TITLES = {
    "collapse": "Collapse of the curves of all grids",
    "infinite": "Exponents of an infinitely fine grid",
    "needed": "Grids needed for an exponent, extrapolated",
}
COLUMNS = {"collapse": scaling_collapse.COLUMNS, "infinite": infinite_grid.COLUMNS, "needed": infinite_grid.NEEDED}


def main(discs, lines, *, ranges, conventions, fraction_min, tolerance, seed, **paths):
    """Make the three tables of discs, of their control and of lines.

    discs, lines : pools; ranges : setting `collapse`; conventions : those of the figures; tolerance : of the exponents
    paths : {<table>_<csv, html or nc>: path}
    """
    pools, parts = {"discs": read_dataset(discs), "lines": read_dataset(lines)}, {name: [] for name in TITLES}
    how = {name: conventions[name] for name in ("average", "rms_convention")}
    how |= {"elements_min": min(ranges["elements_min"]), "fraction_min": fraction_min}
    how |= {"resamples": ranges["resamples"], "seed": seed}
    ends = {"power": ranges["x_high"], "corrected": ranges["corrected_x_high"]}
    for source, pool in (("discs", "discs"), ("controls", "discs"), ("lines", "lines")):
        found = scaling_collapse.grids(pools[pool], source, **how)
        collapse = scaling_collapse.collapse_table(found, source, x_high=ranges["x_high"], tolerance=tolerance)
        parts["collapse"].append(collapse)
        about = {"elements_min": ranges["elements_min"], "tolerance": tolerance}
        if source != "controls":
            limits, needed = infinite_grid.limit_tables(found, source, x_high=ends, **about)
            parts["infinite"].append(limits)
            parts["needed"].append(needed)
    for name, title in TITLES.items():
        table = pd.concat(parts[name], ignore_index=True)
        files = [paths[f"{name}_{kind}"] for kind in ("csv", "nc", "html")]
        write_table(table, *files, columns=COLUMNS[name], dimension="row", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
