"""Figure 1: an indenter for every Hurst exponent."""

from viscorough.io.datasets import read_dataset
from viscorough_study.figures.style import save_figure
from viscorough_study.figures.surfaces import plot_surfaces
from viscorough_study.job_log import log_to


def main(surfaces, png, pdf):
    """Plot the example discs."""
    ds = read_dataset(surfaces)
    spacing = ds["spacing"].item()
    examples = [(hurst, ds["heights"].sel(hurst=hurst).values, spacing) for hurst in ds["hurst"].values.tolist()]
    save_figure(plot_surfaces(examples), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
