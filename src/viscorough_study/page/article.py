"""Make the article, results/article.pdf, from a Typst template.

The template is filled with the numbers that the page results/index.html shows, and with further tables.
"""

import json
import re

import jinja2
import numpy as np
import typst
import yaml
from markupsafe import Markup

from viscorough import reference
from viscorough.law.calibrated_law import ACROSS
from viscorough_study.comparisons.literature import X_COMPARED
from viscorough_study.fits.conventions import fits
from viscorough_study.page.results import Number, read_published
from viscorough_study.run.readable import readable
from viscorough_study.verdicts.claims import HELD, KINDS, counted_verdicts

# Tolerances with which viscorough.audit and viscorough.indent computed the loading curves of `sum_rules_shown`
# (benchmarks/sum_rules.py).
AUDITED, PLAIN = "1e-05", "1e-03"
# A claim is tested in several cases, such as Hurst exponents. The article lists at most this number of cases with the
# same outcome (pass, undecided or fail).
CASES_MAX = 4
_MARKUP = re.compile(r"""([\\#*_`$<>@\[\]~/"'=+-])""")


def article(project, contents, *, paper, figures, repository):
    """Return the article as the bytes of a PDF file.

    project : folder of the project, which contains template, style, citation, literature and published results
    contents : contents of the page for this run, from assembly.contents_of
    paper : content of resources/paper/numbers.yaml
    figures : folder of the figures
    repository : address of the code, or an empty text
    """
    names = ("style.typ", "article.typ.jinja")
    style, template = ((project / "workflow/article" / name).read_text("utf-8") for name in names)
    environment = jinja2.Environment(
        undefined=jinja2.StrictUndefined, finalize=as_markup, trim_blocks=True, lstrip_blocks=True
    )
    published, results = project / "docs/results", contents["results"]
    citation, law = yaml.safe_load((project / "CITATION.cff").read_text("utf-8")), read_published(published / "law.csv")
    literature = yaml.safe_load((project / "resources/literature/stiffness.yaml").read_text("utf-8"))
    original, sources = citation["references"][0], [source for source in literature if "title" in source]
    sum_rules = json.loads((published / "sum_rules.json").read_text("utf-8"))
    springs = results.rows("interface", source="discs", case_group="base").sort_values("hurst")
    validation = results.tables["validation"]
    text = environment.from_string(template).render(
        contents,
        raw=Markup,
        citation=citation,
        original=original,
        repository=Markup(json.dumps(repository)) if repository else "",  # text in quotes, as Typst needs it
        paper=paper,
        physics=counted_physics(results.tables["claims"]),
        cases={name: cases_by_outcome(results, name) for name in contents["overall"]},
        prefactors=prefactors(results, contents["conventions"]),
        small_hurst=small_hurst(results),
        sources=sources_by_basis(sources),
        bibliography=Markup(json.dumps(bibliography(original, sources), ensure_ascii=False)),
        validation=validation[validation["elements"] == validation["elements"].max()].to_dict("records"),
        springs=springs.to_dict("records"),
        law=law[law["across"] == ACROSS].to_dict("records"),
        plateaus=results.tables["plateaus"].to_dict("records"),
        control=control(results),
        x_compared=X_COMPARED,
        earlier=results.rows("literature", source="Pohrt and Popov").iloc[0],
        sum_rules=sum_rules_shown(sum_rules),
        audited={"plain": float(PLAIN), "audit": float(AUDITED), "across": sum_rules["across"]},
        outside=read_published(published / "outside.csv").to_dict("records"),
        origins=json.loads((published / "published.json").read_text("utf-8")),
    )
    return typst.compile((style + text).encode(), root=figures, ignore_system_fonts=True)


def as_markup(value):
    """Return the Typst text of a value that fills a placeholder of the template.

    Numbers are written with three digits. In other values, all characters that mean markup in Typst are escaped. A
    value of the type `Markup` is returned unchanged.
    """
    if isinstance(value, Markup):
        return value
    if isinstance(value, Number):
        return readable(value.value)
    if isinstance(value, int | float | np.number):
        return readable(float(value))
    return _MARKUP.sub(r"\\\1", str(value))


def counted_physics(table):
    """Count the claims on physics by verdict; return {"heading", "all", "counts"}.

    heading : heading of these claims on the page
    all : number of these claims
    counts : {verdict: number of claims with this verdict}, from the best verdict to the worst
    table : table of all claims, with one row for each case in which a claim is tested
    """
    counts = dict(counted_verdicts(table))
    return {"heading": KINDS["physics"], "all": sum(counts.values()), "counts": counts}


def cases_by_outcome(results, claim):
    """Sort the cases in which a claim was tested by their outcome; return {"pass", "undecided", "fail", "paper"}.

    pass, undecided, fail : {"cases": list, "more": number} of the cases with this outcome. The list has at most
        `CASES_MAX` cases, those farthest from the paper's value; `more` is the number of omitted cases
    paper : the paper's value if it is the same for all cases; otherwise None, and each case states the paper's value
    """
    rows = results.rows("claims", claim=claim)
    undecided = rows["verdict"] == "undecided"
    held = rows["verdict"].isin(HELD)
    shared = rows["expected"].nunique(dropna=False) == 1
    shown = {"paper": results.number("claims", rows.index[0], "expected") if shared else None}
    for outcome, members in (("pass", rows[held]), ("undecided", rows[undecided]), ("fail", rows[~held & ~undecided])):
        distance = (members["value"] - members["expected"]).abs().fillna(0.0)
        listed = members.loc[sorted(distance.sort_values(ascending=False, kind="stable").index[:CASES_MAX])]
        records = [results.record("claims", row) | {"own_value": not shared} for row in listed.index]
        shown[outcome] = {"cases": records, "more": len(members) - len(listed)}
    return shown


def prefactors(results, conventions):
    """Compare the prefactor ζ of the discs with the paper's Eqs. 4 and 11, at each Hurst exponent H; return a dict.

    ζ depends on conventions, which are choices that the paper leaves open, such as the kind of mean over surfaces.

    rows : a dict for each H, with
        value, low, high : ζ and its interval in the conventions of the figures
        least, largest : smallest and largest ζ in any conventions
        eq_4 : ζ from Eq. 4
        eq_11 : ζ from Eq. 11, converted to a law without the factor 1/Γ(2 − α)
        ratio_if_radius : ratio of ζ to Eq. 11, both for a law with this factor, if L were the radius of the disc
    between : True if ζ lies between Eq. 4 and Eq. 11 at every H
    conventions : number of combinations of conventions
    agreeing : number of combinations in which ζ agrees with a formula within the tolerance; the largest such number for
        any formula and H
    radius : smallest and largest ratio_if_radius
    """
    every, rows = results.rows("scaling", source="discs", case_group="base"), []
    for row in fits(every, conventions | {"gamma": "without"}).itertuples():
        zeta, eq_11 = every.loc[every["hurst"] == row.hurst, "zeta"], reference.zeta_viscous(row.hurst)
        numbers = {"hurst": row.hurst, "value": row.zeta, "low": row.zeta_low, "high": row.zeta_high}
        numbers |= {"least": zeta.min(), "largest": zeta.max()}
        without_gamma = eq_11 * _gamma(reference.exponent_beta(row.hurst))
        numbers |= {"eq_4": reference.zeta_elastic(row.hurst), "eq_11": without_gamma}
        # If L is the radius instead of the diameter, X and κ double, so ζ = κ/X^α grows by the factor 2^(1−α) = 2^β.
        rows.append(numbers | {"ratio_if_radius": 2**row.beta * row.zeta / _gamma(row.beta) / eq_11})
    ratios = [row["ratio_if_radius"] for row in rows]
    both = results.tables["claims"].query("claim in ('zeta_elastic', 'zeta_viscous')")
    return {
        "rows": rows,
        "between": all(row["eq_4"] < row["value"] < row["eq_11"] for row in rows),
        "conventions": both["conventions"].max(),
        "agreeing": both["agreeing"].max(),
        "radius": (min(ratios, default=np.nan), max(ratios, default=np.nan)),
    }


def _gamma(beta):
    """Return Γ(2 − α) with α = 1 − β."""
    return reference.velocity_law(1.0, 1.0, 1 - beta) / reference.velocity_law(1.0, 1.0, 1 - beta, gamma=True)


def small_hurst(results):
    """Return numbers for the discussion of the smallest Hurst exponent of the discs, where β differs from H/(1 + H).

    hurst : smallest Hurst exponent H
    region : row of table `plateaus` for this H, with the length of region (b), where vt/h follows a power law of X
    own : β of lines minus β of discs, with lines and discs fitted in their own regions (b)
    equal : β of lines minus β of discs, with lines and discs fitted in the same range of X
    grid : factor by which a tenfold number of elements changes the stiffness κ at the depth u = h
    literature : row of table `literature` with the range of α that others found between H = 1 and H = 0, and with α of
        this run at its smallest H

    `own`, `equal`, `grid` and `literature` are None if the run has no such value.
    """
    claims, plateaus = results.tables["claims"], results.rows("plateaus", case_group="base")
    hurst = plateaus["hurst"].min()

    def case(claim, beginning):
        rows = claims[(claims["claim"] == claim) & claims["case"].str.startswith(beginning)].dropna(subset=["value"])
        return results.record("claims", rows.index[0]) if len(rows) else None

    quoted = results.rows("literature", quantity="alpha").dropna(subset=["hurst", "theirs_low"])
    quoted = quoted[quoted["theirs_low"] < quoted["theirs_high"]].sort_values("hurst")
    return {
        "hurst": hurst,
        "region": plateaus.loc[plateaus["hurst"].idxmin()].to_dict(),
        "own": case("coincide", f"H = {hurst:g}"),
        "equal": case("coincide_equal_windows", f"H = {hurst:g}, same X"),
        "grid": case("no_grid", f"H = {hurst:g}, κ at u/h = 1"),
        "literature": results.record("literature", quoted.index[0]) if len(quoted) else None,
    }


# ---- references


def citation_key(source):
    """Return the key of a source in the bibliography: up to three surnames and the year, such as "persson-2007"."""
    names = source["source"].replace(" and ", ", ").split(", ")
    return "-".join([*names[:3], str(source["year"])]).lower().replace(" ", "-")


def sources_by_basis(sources):
    """Group sources by how their findings are known, for example from the "abstract"; return {basis: keys of sources}.

    sources : entries of resources/literature/stiffness.yaml; their field `sure` is the basis
    """
    groups = {}
    for source in sources:
        groups.setdefault(source["sure"], []).append(citation_key(source))
    return groups


def bibliography(original, sources):
    """Return the bibliography as YAML text in the format Hayagriva, which Typst reads.

    The key of the paper is "paper". The key of each source is its `citation_key`.

    original : entry of the paper in CITATION.cff
    sources : entries of resources/literature/stiffness.yaml that have a title
    """
    authors = [f"{author['family-names']}, {author['given-names']}" for author in original["authors"]]
    place = f"{original['journal']} {original['volume']}, {original['start']}"
    entries = {"paper": _entry(original["title"], authors, place, original["year"])}
    for source in sources:
        authors = source["source"].replace(" and ", ", ").split(", ")
        entries[citation_key(source)] = _entry(source["title"], authors, source["place"], source["year"])
    return yaml.safe_dump(entries, allow_unicode=True)


def _entry(title, authors, place, year):
    parent = {"type": "periodical", "title": place}
    return {"type": "article", "title": title, "author": authors, "date": year, "parent": parent}


# ---- tables


def control(results):
    """Return the rows of table `periodic` with the largest compliance g, as a list with a dict for each Hurst exponent.

    g is the compliance of the rough interface on a periodic half-space (comparisons.periodic_control).

    hurst : Hurst exponent
    surfaces : number of surfaces
    whole : row with the largest g, for surfaces whose spectrum has no roll-off
    rolled : row with the largest g, for surfaces whose spectrum has a roll-off
    """
    table, rows = results.tables["periodic"], []
    for hurst, part in table.groupby("hurst"):
        kinds = (part[part["roll_off_wavelength"].notna() == flag] for flag in (False, True))
        whole, rolled = (kind.loc[kind["g"].idxmax()] for kind in kinds)
        rows.append({"hurst": hurst, "surfaces": whole["surfaces"], "whole": whole, "rolled": rolled})
    return rows


def sum_rules_shown(content):
    """Return, for each indenter, how far loading curves deviate from the sum rules, two integrals with exact values.

    See viscorough.contact.sum_rules.

    plain : relative deviations, as absolute values, for a curve from viscorough.indent
    audit : relative deviations, as absolute values, for a curve from viscorough.audit
    levels : number of levels, which are computed contacts, of the curve from viscorough.audit
    content : content of docs/results/sum_rules.json
    """
    return [
        {
            "indenter": name,
            "plain": {rule: abs(rules["plain"][PLAIN][rule]["by levels"]) for rule in ("first", "second")},
            "audit": {rule: abs(rules["audit"][AUDITED][rule]["by levels"]) for rule in ("first", "second")},
            "levels": rules["audit"][AUDITED]["levels"],
        }
        for name, rules in content["indenters"].items()
    ]
