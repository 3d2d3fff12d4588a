"""Pages of tables, for Snakemake's report."""

from pathlib import Path

from viscorough.io.atomic import atomic_write
from viscorough_study.page.html_table import html_table
from viscorough_study.run.job_log import log_to


def main(template, csv, nc, html):
    """Write the page of every table; csv, nc, html : paths in the same order; template : path of the pages' template"""
    text = Path(template).read_text(encoding="utf-8")
    for table, described, page in zip(csv, nc, html, strict=True):
        with atomic_write(page) as temporary:
            temporary.write_text(html_table(text, table, described), encoding="utf-8")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(Path(job.scriptdir).resolve().parent / "page/table.html.jinja", **job.input, **job.output)
