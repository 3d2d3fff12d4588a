"""The page of the results, results/index.html."""

from pathlib import Path

from viscorough.io.atomic import atomic_write
from viscorough_study.page.assembly import contents_of, page
from viscorough_study.run.job_log import log_to


def main(project, discs, lines, other_solvers, tables, figures, page_file, *, claims, numbers, alternative):
    """Write the page.

    project : folder of the project, which has template, style, captions, published numbers and verdicts, and the
        picture of the rules
    other_solvers : [] or [path of their table]; tables, figures : paths, whose stems name them
    alternative : {figure: text for those who cannot see it}
    """
    tables, figures = ({Path(path).stem: path for path in paths} for paths in (tables, figures))
    captions = {name: project / f"workflow/report/figures/{name}.rst" for name in figures}
    names = ("page.html.jinja", "style.css", "calculator.html", "calculator.js")
    *texts, section, script = [(project / "workflow/page" / name).read_text("utf-8") for name in names]
    (others,) = other_solvers or [project / "resources/published/other_solvers.csv"]
    published = {"other_solvers": others, "published": project / "docs/claims.csv"}
    contents = contents_of(discs, lines, tables=tables, claims=claims, numbers=numbers, **published)
    more = {"calculator": (section, script), "rules": project / "docs/rules.png", "alternative": alternative}
    html = page(*texts, contents, figures=figures, captions=captions, **more)
    with atomic_write(page_file) as temporary:
        temporary.write_text(html, encoding="utf-8")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(Path(job.scriptdir).resolve().parents[1], **job.input, page_file=job.output.page, **job.params)
