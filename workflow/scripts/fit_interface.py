"""Tables of the interface and the punch in series: plateau and law of every ensemble, and its curves."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.interface import COLUMNS, CURVES, ensembles_of, interface_tables
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import recorded, write_table


def main(pools, csv, nc, curves_csv, curves_nc, *, fit, rms_convention):
    """Take discs and lines apart into interface and punch, lines at the Hurst exponents of the discs.

    pools : discs, lines, and discs and lines on grids from coarse to fine
    fit : further arguments of interface_tables; rms_convention : of the discs
    """
    discs, lines, size_discs, size_lines = map(read_dataset, pools)
    discs, size_discs = (pool.sel(rms_convention=[rms_convention]) for pool in (discs, size_discs))
    cases = ensembles_of(discs, "discs", "base") + ensembles_of(size_discs, "discs", "sizes")
    hursts = {about["hurst"] for about, _, _ in cases}
    cases += ensembles_of(lines, "lines", "lines", hursts) + ensembles_of(size_lines, "lines", "sizes")
    table, curves = interface_tables(cases, rms_convention, **fit)
    about = {"dimension": "ensemble", "title": "Interface and punch in series", "attributes": recorded(settings=fit)}
    write_table(table, csv, nc, columns=COLUMNS, **about)
    about = {"dimension": "abscissa", "title": "Curves of the interface alone"}
    write_table(curves, curves_csv, curves_nc, columns=CURVES, **about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
