"""The article, results/article.pdf: its text in Typst, filled with the contents of the page and with further tables."""

import json
import re
from collections import defaultdict

import jinja2
import numpy as np
import typst
import yaml

from viscorough import reference
from viscorough.calibrated_law import ACROSS
from viscorough_study.fits.conventions import select, source_values
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
        prefactors=prefactors(results, contents["conventions"]),
        earlier=results.rows("literature", source="Pohrt and Popov").iloc[0],
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
    """The largest g of periodic surfaces and its X, for each Hurst exponent, without and with a roll-off."""
    table, rows = results.tables["periodic"], []
    for hurst, part in table.groupby("hurst"):
        kinds = (part[part["roll_off_wavelength"].notna() == flag] for flag in (False, True))
        whole, rolled = (kind.loc[kind["g"].idxmax()] for kind in kinds)
        rows.append({"hurst": hurst, "surfaces": whole["surfaces"], "whole": whole, "rolled": rolled})
    return rows


def prefactors(results, conventions):
    """ζ of Eq. 4, of boundary elements, and of Eq. 11 without the factor 1/Γ(2 − α), for each Hurst exponent.

    as_radius : ζ with the factor over Eq. 11 if L were the radius, for which ζ is 2^β times as large
    """
    wanted = conventions | source_values("discs") | {"case_group": "base"}
    fits, with_factor = (
        select(results.tables["scaling"], wanted | {"gamma": gamma}).sort_values("hurst")
        for gamma in ("without", "with")
    )
    hurst = fits["hurst"].to_numpy()
    columns = {
        "hurst": hurst,
        "elastic": reference.zeta_elastic(hurst),
        "here": fits["zeta"].to_numpy(),
        "viscous": 1 / reference.rate_law(1.0, hurst, gamma=True),
        "as_radius": 2 ** fits["beta"].to_numpy() * with_factor["zeta"].to_numpy() / reference.zeta_viscous(hurst),
    }
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


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
