"""Table of the laws of the prefactor, absolute and up to a factor common to all Hurst exponents."""

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.power_law import named_windows
from viscorough_study.fits.zeta_laws import COLUMNS, zeta_laws
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import recorded, write_table


def main(discs, csv, nc, *, conventions, hurst_mins, fit, resamples, seed):
    """Compare base discs with the laws.

    conventions : average and rms convention, as in the figures; hurst_mins : lowest Hurst exponents compared
    fit : arguments of named_windows, whose window `default` is taken; resamples, seed : of the bootstrap
    """
    pool = select(read_dataset(discs), group="base").sel(rms_convention=[conventions["rms_convention"]])
    pooled = {hurst: one.isel(rms_convention=0) for hurst, one in sorted(ensembles(pool, "hurst").items())}
    windows = {hurst: named_windows(one, **fit)["default"] for hurst, one in pooled.items()}
    how = {"average": conventions["average"], "resamples": resamples, "seed": seed}
    table = zeta_laws(pooled, windows, hurst_mins, **how)
    about = {"title": "Laws of the prefactor", "attributes": recorded(settings={"conventions": conventions, **how})}
    write_table(table, csv, nc, columns=COLUMNS, dimension="comparison", **about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
