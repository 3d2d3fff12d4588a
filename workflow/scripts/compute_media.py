"""Kinetics of the discs in other media, from their loading curves."""

from viscorough.io import netcdf
from viscorough.io.curves import unstack_curves
from viscorough_study.ensembles import abscissa
from viscorough_study.job_log import log_to
from viscorough_study.media_kinetics import COLUMNS, media_table, named_media
from viscorough_study.tables import recorded, write_table


def main(curves, csv, html, nc, *, rms_convention, force, times, cases):
    """Tabulate the kinetics.

    curves : files of batches; rms_convention : of h; force : F [N]; times : low, high [s] and per_decade
    cases : [name and further keys of a medium]
    """
    ensembles = {}
    for path in curves:
        batch = netcdf.read(path)
        values = {name: variable.values for name, variable in batch.variables.items()}
        all_curves, rms, diameter = ensembles.get(values["hurst"].item(), ([], [], values["diameter"].item()))
        joined = [*all_curves, *unstack_curves(batch)], [*rms, *values[f"rms_{rms_convention}"]], diameter
        ensembles[values["hurst"].item()] = joined
    table = media_table(ensembles, named_media(cases), force=force, times=abscissa(**times))
    about = recorded(settings={"force": force, "times": times, "cases": cases})
    title = "Kinetics of the discs in other media"
    write_table(table, csv, nc, html, columns=COLUMNS, dimension="point", title=title, attributes=about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
