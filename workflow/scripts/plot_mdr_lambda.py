"""Draw the factor λ and the exponents of lines that represent discs."""

from viscorough_study.figures.mdr_lambda import plot_mdr_lambda
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(mdr_lambda, mdr_exponents, figure):
    """Write the figure.

    mdr_lambda, mdr_exponents : CSV files of comparisons.mdr_equivalence; figure : file to write
    """
    save_figure(plot_mdr_lambda(*map(read_table, (mdr_lambda, mdr_exponents))), figure)


run_job(globals(), main)
