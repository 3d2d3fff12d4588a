"""Kinetics of the discs in other media, from their loading curves."""

import numpy as np

from viscorough.io import netcdf
from viscorough.io.curves import unstack_curves
from viscorough_study.comparisons.media_kinetics import COLUMNS, EXPONENT_COLUMNS, media_tables, named_media
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import recorded, write_table


def main(curves, csv, nc, exponents_csv, exponents_nc, *, discs, until_x, cases, **how):
    """Tabulate the kinetics.

    curves : files of batches, of which the curves of the ensembles `discs` are taken that were to reach X = until_x
    cases : [name and further keys of a medium]
    how : rms_convention, of h, and further arguments of media_tables; times : low, high [s] and per_decade
    """
    ensembles, about, convention = {}, recorded(settings={"cases": cases, **how}), how.pop("rms_convention")
    for path in curves:
        batch = netcdf.read(path)
        values = {name: variable.values for name, variable in batch.variables.items()}
        read, heights = unstack_curves(batch), values[f"rms_{convention}"]
        diameter, hurst = np.broadcast_to(values["diameter"], heights.shape), values["hurst"].item()
        for i in np.flatnonzero(np.isin(values["case"].astype(str), discs) & (values["until_x"] == until_x)):
            joined, rms, _ = ensembles.get(hurst, ([], [], None))
            ensembles[hurst] = [*joined, read[i]], [*rms, heights[i]], diameter[i]
    table, exponents = media_tables(ensembles, named_media(cases), **how | {"times": abscissa(**how["times"])})
    of_table = {"columns": COLUMNS, "dimension": "point", "title": "Kinetics of the discs in other media"}
    write_table(table, csv, nc, attributes=about, **of_table)
    of_table = {"columns": EXPONENT_COLUMNS, "dimension": "fit", "title": "Exponents of time in other media"}
    write_table(exponents, exponents_csv, exponents_nc, attributes=about, **of_table)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
