"""Make the page from the tables, figures and loading curves of a run."""

from pathlib import Path

import yaml
from markupsafe import Markup

from viscorough_study.fits.fine_sentence import fine_grids_sentence, judged_rows
from viscorough_study.page import content
from viscorough_study.page.calculator import calculator
from viscorough_study.page.chart import chart
from viscorough_study.page.render import embedded_png, render
from viscorough_study.page.results import read_results
from viscorough_study.robustness.outcomes import VERDICTS as OUTCOMES
from viscorough_study.run.made_with import all_versions, read_record
from viscorough_study.run.names import SHOWN
from viscorough_study.run.readable import readable
from viscorough_study.run.tables import split_table
from viscorough_study.verdicts.claim import KINDS


def page_of(project, discs, figures, *, published, combinations, fraction_min, **run):
    """Return the HTML of the page.

    project : folder of the project, which contains templates, captions, published numbers, and the picture of the rules
    discs : NetCDF file with the loading curves of all discs of the run (ensembles.pool)
    figures : paths of the figures; the name of a file without suffix is the name of the figure
    published : {figure in docs/results that the page shows, too: command that draws it}
    combinations : {name of the ensemble: force [N], viscosity [Pa s], diameter [m], rms [m]}
    fraction_min : least share of the realizations behind a mean of the interactive Figure 2
    run : further arguments of `contents_of`
    """
    folder, figures = project / "workflow/page", {Path(path).stem: path for path in figures}
    figures |= {name: project / "docs/results" / f"{name}.png" for name in published}
    captions = {name: project / f"workflow/report/figures/{name}.rst" for name in figures}
    template, style = ((folder / name).read_text("utf-8") for name in ("page.html.jinja", "style.css"))
    contents = contents_of(project, discs, **run)
    parts = {
        "published": published,
        "alternative": yaml.safe_load((folder / "figures.yaml").read_text("utf-8")),
        "calculator": calculator(folder),
        "chart": chart(folder, discs, combinations, SHOWN, fraction_min),
        "origin": Markup((folder / "origin.js").read_text("utf-8")),
        "sketch": Markup((folder / "sketch.svg").read_text("utf-8")),
        "rules": embedded_png((project / "docs/rules.png").read_bytes()),
    }
    return render(template, style, figures, captions, **parts, **contents)


def contents_of(project, discs, lines, *, tables, numbers, changed, files):
    """Return the variables for the template of the page, {name: content}.

    project : folder of the project, which contains published numbers
    discs, lines : NetCDF files with the loading curves of all discs and of all lines of the run (ensembles.pool)
    tables : paths of CSV files; a table has the name of its file without the suffix
    numbers : content of resources/paper/numbers.yaml
    changed : {setting: (value, default value)} of all settings of the run that are not the default
    files : settings files of the run
    """
    tables = {Path(path).stem: path for path in tables}
    results = read_results(tables)
    claims = content.claims(results)
    texts = yaml.safe_load((project / "workflow/page/in_short.yaml").read_text("utf-8"))
    return {
        "results": results,
        "conventions": SHOWN,
        "readable": readable,
        "scale": content.scale(discs, lines, numbers),
        "claims": claims,
        "findings": content.findings(claims),
        "fine_grids": fine_grids_sentence(judged_rows(project)),
        "in_short": content.in_short(claims, texts),
        "verdict_counts": content.verdict_counts(results),
        "mark": content.mark,
        "kinds": KINDS,
        "models": results.records("sufficient_models"),
        "full_map": results.number("one_surface", results.tables["one_surface"]["across"].idxmax(), "across"),
        "default_run": yaml.safe_load((project / "resources/published/default_run.yaml").read_text("utf-8")),
        "mdr_time": content.mdr_time(results),
        "failures": content.failures(results),
        "outcomes": OUTCOMES,
        "other": content.other_solvers(project / "resources/published/other_solvers.csv"),
        "second": content.second_solver(project / "resources/published/second_solver.csv"),
        "measured": content.measured(results, SHOWN),
        "changed": {name: [content.as_yaml(value) for value in pair] for name, pair in changed.items()},
        "files": files,
        "versions": all_versions(map(read_record, [discs, lines, *tables.values()])),
        "machine": split_table(tables["methods"])[0]["machine"],
        "paper_time": numbers["boundary_elements"]["computing_time"]["value"],
    }
