"""Assembly of the page: the content of its template, from tables, ensembles and figures."""

from viscorough_study.page import answers, content
from viscorough_study.page.calculator import calculator as with_law
from viscorough_study.page.discussion import QUANTITIES, discussion
from viscorough_study.page.render import embedded_png, render
from viscorough_study.page.results import netcdf_of, read_results, read_table, readable
from viscorough_study.robustness.failure_map import VERDICTS as OUTCOMES
from viscorough_study.run.rule_costs import duration_text
from viscorough_study.run.tables import read_recorded


def page(template, style, contents, *, figures, captions, calculator, rules, alternative):
    """HTML of the page.

    template, style : text of the template and of the style sheet
    contents : of the run, see `contents_of`; figures, captions : {name: path}, of PNG and reStructuredText
    calculator : (section, script), its texts of HTML and JavaScript
    rules : path of a picture of the workflow; alternative : {figure: alternative text}
    """
    return render(
        template,
        style,
        figures,
        captions,
        calculator=with_law(*calculator),
        rules=embedded_png(rules.read_bytes()),
        alternative=alternative,
        **contents,
    )


def contents_of(discs, lines, *, other_solvers, tables, claims, numbers, published):
    """{name: content} of a run, for the templates of page and article.

    discs, lines : paths of the pools; other_solvers : path of a table of the workflow or of published numbers
    tables : {name: path of the CSV}
    claims, numbers : contents of resources/paper/claims.yaml and numbers.yaml
    published : path of the table of verdicts of the full scale
    """
    results = read_results(tables)
    conventions = results.settings["claims"]["conventions"]
    scale, verdicts = content.scale(discs, lines, numbers), content.verdicts(results, claims, read_table(published))
    fastest = answers.fastest_methods(results)
    costs_nc = netcdf_of(tables["rule_costs"])
    return {
        "results": results,
        "conventions": conventions,
        "readable": readable,
        "scale": scale,
        "answers": answers.answers(results),
        "verdict_counts": answers.verdict_counts(results),
        "verdict_short": content.VERDICT_SHORT,
        "overall": {claim["name"]: claim["verdict"] for claims in verdicts.values() for claim in claims},
        "verdicts": verdicts,
        "differing": [claim for claims in verdicts.values() for claim in claims if claim["full_scale"]],
        "groups": answers.GROUPS,
        "fastest_methods": fastest,
        "advised": next(row["fastest"] for row in fastest if row["error"] == answers.ADVISED),
        "advised_elements": results.number("methods", answers.rough_disc(results).index[0], "elements"),
        "best_model": answers.best_model(results),
        "failures": answers.failures(results),
        "outcomes": OUTCOMES,
        "other": content.other_solvers(other_solvers),
        "scenes": content.scenes(results),
        "media": content.media(results),
        "literature": discussion(results),
        "quantities": QUANTITIES,
        "measured": content.measured(results, conventions),
        "choices": ("automatic", "best by hand", "naive"),
        "settings": content.settings_list(results, scale),
        "costs": content.costs(results),
        "machine": results.machine["rule_costs"],
        "versions": read_recorded(costs_nc, "versions"),
        "made": read_recorded(costs_nc, "made"),
        "time": duration_text(results.tables["rule_costs"]["share_s"].sum()),
        "paper_time": numbers["boundary_elements"]["computing_time"]["value"],
    }
