"""The article, results/article.pdf."""

from pathlib import Path

from viscorough.io.atomic import atomic_write
from viscorough_study.page.article import article
from viscorough_study.page.assembly import contents_of
from viscorough_study.run.job_log import run_job


def main(project, figures, pdf, **run):
    """Write the article.

    project : folder of the project, which has template, style, citation, published numbers and verdicts
    figures : paths, which the template names from their folder; run : further arguments of `contents_of`
    """
    content = article(project, contents_of(project, **run), paper=run["numbers"], figures=Path(figures[0]).parent)
    with atomic_write(pdf) as temporary:
        temporary.write_bytes(content)


run_job(globals(), lambda job: main(Path(job.scriptdir).resolve().parents[1], **job.input, **job.output, **job.params))
