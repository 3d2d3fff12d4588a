"""Make the page of the results, results/index.html."""

from pathlib import Path

from viscorough.io.atomic import atomic_write
from viscorough_study.page.assembly import contents_of
from viscorough_study.page.calculator import calculator
from viscorough_study.page.render import embedded_png, render
from viscorough_study.run.job_log import run_job


def main(project, figures, page, *, alternative, **run):
    """Write the page.

    project : folder of the project, which contains the template, the style, the captions, the published numbers and
        verdicts, and the picture of the rules
    figures : paths of the figures; the name of a file without suffix is the name of the figure
    page : file to write
    alternative : {figure: description for readers who cannot see the figure}
    run : further arguments of `contents_of`
    """
    figures = {Path(path).stem: path for path in figures}
    captions = {name: project / f"workflow/report/figures/{name}.rst" for name in figures}
    names = ("page.html.jinja", "style.css", "calculator.html", "calculator.js")
    *texts, section, script = [(project / "workflow/page" / name).read_text("utf-8") for name in names]
    parts = {
        "calculator": calculator(section, script),
        "rules": embedded_png((project / "docs/rules.png").read_bytes()),
    }
    html = render(*texts, figures, captions, alternative=alternative, **parts, **contents_of(project, **run))
    with atomic_write(page) as temporary:
        temporary.write_text(html, encoding="utf-8")


run_job(globals(), lambda job: main(Path(job.scriptdir).resolve().parents[1], **job.input, **job.output, **job.params))
