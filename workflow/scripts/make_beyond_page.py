"""Make the page of what goes beyond the paper, results/beyond.html."""

from pathlib import Path

from viscorough.io.atomic import atomic_write
from viscorough_study.page.beyond import beyond_page
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table

# Snakemake lets __file__ be the path of this script.
PROJECT = Path(__file__).resolve().parents[2]


def main(literature, figures, page):
    """Write the page; literature : CSV file of comparisons.literature; figures : PNG files; page : file to write"""
    html = beyond_page(PROJECT, read_table(literature), figures)
    with atomic_write(page) as temporary:
        temporary.write_text(html, encoding="utf-8")


run_job(globals(), main)
