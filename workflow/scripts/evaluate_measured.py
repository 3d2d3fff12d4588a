"""Tables of measured surfaces: the scans, the power laws of their groups, and their kinetics."""

from viscorough.io import netcdf
from viscorough.io.datasets import read_dataset
from viscorough_study.comparisons.measured import COLUMNS as SCANS
from viscorough_study.comparisons.measured import KINETICS, group_fits, scans_and_kinetics
from viscorough_study.comparisons.media_kinetics import named_media
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.ensembles.pool import ensembles
from viscorough_study.fits.fit_table import COLUMNS
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import write_table


def main(pool, curves, scans, fits, kinetics, *, media, times, fit, seed, **of_scans):
    """Tabulate; outputs are lists of CSV and NetCDF.

    curves : files of the scans; of_scans : names, and forces [N] of each scan
    media : mappings with a name and the keys of a medium; times : low, high [s], per_decade
    fit : settings in section `scaling`
    """
    asked = {"media": named_media(media), "times": abscissa(**times)}
    about, motions = scans_and_kinetics(map(netcdf.read, curves), **asked, **of_scans)
    fitted = group_fits(ensembles(read_dataset(pool), "group"), seed=seed, **fit)
    for table, columns, (csv, nc), title in (
        (about, SCANS, scans, "Measured surfaces"),
        (fitted, COLUMNS, fits, "Power laws of groups of measured surfaces in region (b)"),
        (motions, KINETICS, kinetics, "Kinetics of measured surfaces"),
    ):
        write_table(table, csv, nc, columns=columns, dimension="row", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
