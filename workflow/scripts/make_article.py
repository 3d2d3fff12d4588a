"""Make the article, results/article.pdf."""

from pathlib import Path

from viscorough.io.atomic import atomic_write
from viscorough_study.page.article import article
from viscorough_study.page.assembly import contents_of
from viscorough_study.run.job_log import run_job


def main(project, figures, pdf, *, repository, **run):
    """Write the article.

    project : folder of the project, which contains the template, the style, the citation, the list of literature, and
        the published numbers and verdicts
    figures : paths of the figures, all in one folder; the template has only the names of the files
    pdf : file to write
    repository : address of the code, for the text of the article; may be empty
    run : further arguments of `contents_of`
    """
    contents, folder = contents_of(project, **run), Path(figures[0]).parent
    content = article(project, contents, paper=run["numbers"], figures=folder, repository=repository)
    with atomic_write(pdf) as temporary:
        temporary.write_bytes(content)


run_job(globals(), lambda job: main(Path(job.scriptdir).resolve().parents[1], **job.input, **job.output, **job.params))
