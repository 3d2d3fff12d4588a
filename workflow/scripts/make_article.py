"""The article, results/article.pdf."""

from pathlib import Path

from viscorough.io.atomic import atomic_write
from viscorough_study.page.article import article
from viscorough_study.page.assembly import contents_of
from viscorough_study.run.job_log import log_to


def main(project, figures, article_file, **run):
    """Write the article.

    project : folder of the project, which has template, style, citation, published numbers and verdicts
    figures : paths, which the template names from their folder; run : further arguments of `contents_of`
    """
    pdf = article(project, contents_of(project, **run), paper=run["numbers"], figures=Path(figures[0]).parent)
    with atomic_write(article_file) as temporary:
        temporary.write_bytes(pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(Path(job.scriptdir).resolve().parents[1], **job.input, article_file=job.output.article, **job.params)
