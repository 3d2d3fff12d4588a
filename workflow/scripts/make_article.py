"""The article, results/article.pdf."""

from pathlib import Path

from viscorough.io.atomic import atomic_write
from viscorough_study.page.article import article
from viscorough_study.page.assembly import contents_of
from viscorough_study.run.job_log import log_to


def main(project, discs, lines, other_solvers, tables, figures, article_file, *, claims, numbers):
    """Write the article.

    project : folder of the project, which has template, style, citation, published numbers and verdicts
    other_solvers : [] or [path of their table]; tables : paths, whose stems name them
    figures : paths, which the template names from their folder
    """
    tables = {Path(path).stem: path for path in tables}
    (others,) = other_solvers or [project / "resources/published/other_solvers.csv"]
    published = {"other_solvers": others, "published": project / "docs/claims.csv"}
    contents = contents_of(discs, lines, tables=tables, claims=claims, numbers=numbers, **published)
    pdf = article(project, contents, paper=numbers, figures=Path(figures[0]).parent)
    with atomic_write(article_file) as temporary:
        temporary.write_bytes(pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(Path(job.scriptdir).resolve().parents[1], **job.input, article_file=job.output.article, **job.params)
