"""Make the page of the results, results/index.html."""

from pathlib import Path

import yaml

from viscorough.io.atomic import atomic_write
from viscorough_study.page.assembly import contents_of
from viscorough_study.page.calculator import calculator
from viscorough_study.page.chart import chart
from viscorough_study.page.render import embedded_png, render
from viscorough_study.run.job_log import run_job

# Folder of the project: the template, the style, the captions, the published numbers and verdicts, the picture of the
# rules. Snakemake lets __file__ be the path of this script.
PROJECT = Path(__file__).resolve().parents[2]


def main(discs, figures, page, *, fraction_min, **run):
    """Write the page.

    discs : NetCDF file with the loading curves of all discs of the run (ensembles.pool)
    figures : paths of the figures; the name of a file without suffix is the name of the figure
    page : file to write
    fraction_min : least share of the realizations behind a mean of the interactive Figure 2
    run : further arguments of `contents_of`
    """
    figures = {Path(path).stem: path for path in figures}
    captions = {name: PROJECT / f"workflow/report/figures/{name}.rst" for name in figures}
    alternative = yaml.safe_load((PROJECT / "workflow/page/figures.yaml").read_text("utf-8"))
    folder = PROJECT / "workflow/page"
    names = ("page.html.jinja", "style.css", "calculator.html", "calculator.js")
    *texts, section, script = [(folder / name).read_text("utf-8") for name in names]
    files = {"library": "uplot/uPlot.iife.min.js", "style": "uplot/uPlot.min.css", "script": "chart.js"}
    of_chart = {name: (folder / file).read_text("utf-8") for name, file in files.items()}
    contents = contents_of(PROJECT, discs, **run)
    parts = {
        "calculator": calculator(section, script),
        "chart": chart(discs, contents["conventions"], fraction_min, **of_chart),
        "rules": embedded_png((PROJECT / "docs/rules.png").read_bytes()),
    }
    html = render(*texts, figures, captions, alternative=alternative, **parts, **contents)
    with atomic_write(page) as temporary:
        temporary.write_text(html, encoding="utf-8")


run_job(globals(), main)
