"""Make the page of what goes beyond the paper from the figures and the table of the literature."""

from pathlib import Path

import yaml

from viscorough_study.page.render import render
from viscorough_study.run.readable import readable


def beyond_page(project, literature, figures):
    """Return the HTML of the page.

    project : folder of the project, which contains the template, the style sheet and the captions
    literature : table of comparisons.literature
    figures : paths of the figures; the name of a file without suffix is the name of the figure
    """
    folder, figures = project / "workflow/page", {Path(path).stem: path for path in figures}
    captions = {name: project / f"workflow/report/figures/{name}.rst" for name in figures}
    template, style = ((folder / name).read_text("utf-8") for name in ("beyond.html.jinja", "style.css"))
    alternative = yaml.safe_load((folder / "figures.yaml").read_text("utf-8"))
    compared = literature[literature["quantity"] != "none"].to_dict("records")
    parts = {"alternative": alternative, "compared": compared, "readable": readable}
    return render(template, style, figures, captions, conventions={}, **parts)
