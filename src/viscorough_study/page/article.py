"""The article, results/article.pdf: its text in Typst, filled with the contents of the page and with further tables."""

import json
import re
from collections import defaultdict

import jinja2
import numpy as np
import typst
import yaml

from viscorough.calibrated_law import ACROSS
from viscorough_study.page.results import Number, read_published
from viscorough_study.run.readable import readable
from viscorough_study.verdicts.claims import counted_verdicts

AUDITED, PLAIN = "1e-05", "1e-03"  # tolerances of the audits and curves whose sum rules are shown
_MARKUP = re.compile(r"""([\\#*_`$<>@\[\]~/"'=+-])""")


def article(project, contents, *, paper, figures):
    """The article, content of a PDF file.

    project : folder of the project, which has template, style, citation and published results
    contents : of a run (assembly.contents_of); paper : content of resources/paper/numbers.yaml
    figures : folder of the figures
    """
    names = ("style.typ", "article.typ.jinja")
    style, template = ((project / "workflow/article" / name).read_text("utf-8") for name in names)
    environment = jinja2.Environment(
        undefined=jinja2.StrictUndefined, finalize=as_markup, trim_blocks=True, lstrip_blocks=True
    )
    published, results = project / "docs/results", contents["results"]
    citation, law = yaml.safe_load((project / "CITATION.cff").read_text("utf-8")), read_published(published / "law.csv")
    sum_rules = json.loads((published / "sum_rules.json").read_text("utf-8"))
    springs = results.rows("interface", source="discs", case_group="base").sort_values("hurst")
    validation = results.tables["validation"]
    text = environment.from_string(template).render(
        contents,
        citation=citation,
        original=citation["references"][0],
        paper=paper,
        physics=counted_physics(results.tables["claims"]),
        titles=titles(contents["verdicts"]),
        validation=validation[validation["elements"] == validation["elements"].max()].to_dict("records"),
        springs=springs.to_dict("records"),
        law=law[law["across"] == ACROSS].to_dict("records"),
        plateaus=results.tables["plateaus"].to_dict("records"),
        control=control(results),
        sum_rules=sum_rules_shown(sum_rules),
        audited={"plain": float(PLAIN), "audit": float(AUDITED), "across": sum_rules["across"]},
        outside=read_published(published / "outside.csv").to_dict("records"),
        origins=json.loads((published / "published.json").read_text("utf-8")),
    )
    return typst.compile((style + text).encode(), root=figures, ignore_system_fonts=True)


def as_markup(value):
    """A value of a placeholder: numbers of three digits, and texts whose signs have no meaning in Typst."""
    if isinstance(value, Number):
        return readable(value.value)
    if isinstance(value, int | float | np.number):
        return readable(float(value))
    return _MARKUP.sub(r"\\\1", str(value))


def counted_physics(table):
    """Number of claims on physics, and {verdict: number of them} from best to worst, of a table of verdicts."""
    counts = dict(counted_verdicts(table))
    return {"all": sum(counts.values()), "counts": counts}


def titles(verdicts):
    """{verdict: titles of its claims of all kinds, with their places in the paper}"""
    named = defaultdict(list)
    for claim in (claim for members in verdicts.values() for claim in members):
        named[claim["verdict"]].append(f"{claim['title']} ({claim['where']})")
    return named


def control(results):
    """g of periodic surfaces at the level nearest to X = 1, for each Hurst exponent, without and with a roll-off."""
    table, rows = results.tables["periodic"], []
    for hurst, part in table.groupby("hurst"):
        part = part[np.log(part["x"]).abs() == np.log(part["x"]).abs().min()]
        whole, rolled = (part[part["roll_off_wavelength"].notna() == flag].iloc[0] for flag in (False, True))
        rows.append({"hurst": hurst, "x": whole["x"], "surfaces": whole["surfaces"], "whole": whole, "rolled": rolled})
    return rows


def sum_rules_shown(content):
    """For each indenter: levels and relative deviations of both integrals, of a plain curve and of an audit."""
    return [
        {
            "indenter": name,
            "plain": {rule: abs(rules["plain"][PLAIN][rule]["by levels"]) for rule in ("first", "second")},
            "audit": {rule: abs(rules["audit"][AUDITED][rule]["by levels"]) for rule in ("first", "second")},
            "levels": rules["audit"][AUDITED]["levels"],
        }
        for name, rules in content["indenters"].items()
    ]
