"""Make the page of the results, results/index.html."""

from pathlib import Path

from viscorough.io.atomic import atomic_write
from viscorough_study.page.assembly import page_of
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import html_line

# Snakemake lets __file__ be the path of this script.
PROJECT = Path(__file__).resolve().parents[2]


def main(page, **run):
    """Write the page; page : file to write; run : further arguments of `page_of`"""
    html = page_of(PROJECT, **run)
    with atomic_write(page) as temporary:
        temporary.write_text(html + html_line(), encoding="utf-8")


run_job(globals(), main)
