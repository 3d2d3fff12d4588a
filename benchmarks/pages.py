"""Write the numbers and tables of published results into README.md and docs/.

Pages mark what is generated. A block of lines is between `<!-- NAME: by benchmarks/pages.py -->` and `<!-- end of NAME
-->`, and a number in a sentence between `<!--n:NAME-->` and `<!--/n-->`. `blocks` and `numbers` compute both from the
tables in docs/results, docs/claims.csv and resources/; `write` replaces them. No line may begin with the mark of a
number, since Markdown would end the paragraph there.
"""

import json
import re
import textwrap
from collections import defaultdict
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.special import gamma as gamma_function

from viscorough.reference import exponent_alpha, exponent_beta, zeta_elastic, zeta_viscous
from viscorough_study.fits import fine_sentence
from viscorough_study.fits.zeta_laws import LAST
from viscorough_study.robustness.outcomes import wrong_without_warning
from viscorough_study.run.paper_data import read_paper
from viscorough_study.verdicts.answer import answer, short_answer
from viscorough_study.verdicts.claims import HELD, counted_verdicts, findings, markdown, overall, verdict_text

ROOT = Path(__file__).resolve().parents[1]
PAGES = [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]
# Results that pages quote, but that are not made by `make paper`.
OTHER_SOLVERS = "resources/published/other_solvers.csv"
FIRST_MINUTES = "resources/published/first_minutes.csv"
FINE_EXPONENTS = fine_sentence.PUBLISHED
DEFAULT_COSTS, DEFAULT_CLAIMS = "resources/published/default_costs.csv", "resources/published/default_claims.csv"
BLOCK = re.compile(r"(<!-- ([\w ]+): by benchmarks/pages\.py -->\n).*?(<!-- end of \2 -->\n)", re.DOTALL)
NUMBER = re.compile(r"(<!--n:([\w ]+)-->).*?(<!--/n-->)", re.DOTALL)
CLAIMS = read_paper(ROOT / "resources/paper", "claims")


def written(text, page_blocks, page_numbers):
    """Return the text of a page with its blocks and numbers; {name: text} of both. Raises KeyError on another name."""
    text = BLOCK.sub(lambda match: f"{match[1]}\n{page_blocks[match[2]]}\n{match[3]}", text)
    return NUMBER.sub(lambda match: match[1] + page_numbers[match[2]] + match[3], text)


def write():
    """Write all blocks and numbers."""
    texts = blocks(), numbers()
    for page in PAGES:
        page.write_text(written(page.read_text(encoding="utf-8"), *texts), encoding="utf-8")


# ---- blocks


def blocks():
    """Return {name: text} of all blocks."""
    table = published_claims()
    return {
        "short answer": "".join(
            textwrap.fill(f"- {text}", 120, subsequent_indent="  ") + "\n" for text in short_answer(table)
        ),
        "counts": paragraph(counts()),
        "answer": paragraph(f"**{answer(table)}**") + "\n" + paragraph(reasons(table)),
        "results": results_table(table),
        "time": time_sentence(),
        "verdicts": markdown(table, CLAIMS) + "\n" + paragraph(other_runs(table)),
        "sentences": sentences(table),
        "prefactors": prefactor_table() + "\n" + paragraph(constants()),
        "fine grids": fine_grids(),
        "sufficient models": sufficient_models(),
        "other solvers": other_solver_times(),
        "large maps": large_maps(),
        "published": published_results(),
    }


def counts():
    """Return the numbers of claims by verdict, own and quoted apart, of the published run and of the default run."""
    texts = []
    for command, name in {"make paper": "docs/claims.csv", "make reproduce": DEFAULT_CLAIMS}.items():
        totals = [counted_verdicts(published_claims(name), origin) for origin in ("own", "quoted")]
        own, quoted = (", ".join(f"{number} {verdict}" for verdict, number in total) for total in totals)
        texts.append(f"`{command}`: {own}; quoted claims: {quoted}.")
    return f"The paper's own claims on physics by {' By '.join(texts)}"


def reasons(table):
    """Return a sentence with the findings that explain the failures."""
    return f"The failures follow from these findings: {'; '.join(findings(table, CLAIMS))}."


def results_table(table):
    """Return the main results as a Markdown table, with the verdicts on the named claims."""
    value, fits, verdicts = table.set_index(["claim", "case"])["value"], prefactors(), verdicts_by_claim(table)
    defined, small = fits[fits["defined"]], value["exponent_small_hurst"]
    with_gamma = listed(defined["zeta_fixed"] / gamma_function(2 - defined["alpha"]))
    hursts, eq_11 = listed(defined.index, "g"), listed(zeta_viscous(defined.index.to_numpy()), ".1f")
    factor = value["one_constant"].index[0].split()[-1]
    contact, end = span(100 * value["complete_contact"].dropna()), span(100 * value["complete_contact_end"])
    rows = {
        "equivalence": ("the viscous problem follows from the elastic one", "direct integration agrees"),
        "collapse": ("curves of all forces, viscosities and sizes collapse", "one curve for each H"),
        "beta": (
            f"β = H/(1 + H), “at least for H > 0.4”: {listed(exponent_beta(np.array([0.6, 0.9])), '.3f')}",
            f"{listed(value['beta'].to_numpy()[-2:], '.3f')} at H = 0.6 and 0.9",
        ),
        "exponent_limit": (
            "no claim for smaller H",
            f"{small['H = 0.4, discs']:.2f} and {small['H = 0.1, discs']:.2f} larger at H = 0.4 and 0.1",
        ),
        "coincide": ("the MDR gives nearly the same β", f"{listed(value['coincide'], '+.2f')} at H = 0.1 to 0.9"),
        "power_law": ("region (b) is nearly linear in log-log axes", f"slope ± {value['power_law'].max():.3f} at most"),
        "master_curve": (
            "all results collapse to one master curve, Eq. 12",
            f"Eq. 12 times {factor} from H = 0.4 on; cause unknown",
        ),
        "zeta_viscous": (f"ζ ≈ 2 − H (Eq. 11): {eq_11}", f"{with_gamma} at H = {hursts}"),
        "zeta_better": ("Eq. 11 fits better than Eq. 4, with 1/Γ(2 − α)", "Eq. 11 is nearer"),
        "gamma": ("factor 1/Γ(2 − α), Eqs. 7 to 9", "absent; changes neither exponent nor collapse"),
        "complete_contact": (
            "region (c), slope 1, is “almost complete” contact",
            f"slope 1 begins at {contact} %, ends at {end} %",
        ),
    }
    verdicts["exponent_limit"] = f"on fine grids: {verdicts['exponent_limit']}"
    of_cases = table.loc[(table["claim"] == "zeta_viscous") & table["value"].notna(), "verdict"].unique()
    verdicts["zeta_viscous"] += f" at H = 0.1, otherwise {' or '.join(of_cases)}"
    lines = [f"| {paper} | {here} | {verdicts[claim]} |" for claim, (paper, here) in rows.items()]
    return markdown_table("| the paper | here | verdict |", lines)


def time_sentence():
    """Return a sentence on the times of the default run and of the paper, with machine and date."""
    machine, measured = first_minutes()[["machine", "measured"]].iloc[-1]
    weeks = read_paper(ROOT / "resources/paper", "numbers")["boundary_elements"]["computing_time"]["value"]
    return paragraph(
        f"**Boundary elements: {weeks} in the paper, {default_minutes()} minutes here**: from `git clone` to the page "
        f"({machine}, {measured}), with as many discs as the paper up to X = 1.8, and with fewer and shorter lines. "
        f"`make paper` takes {costs()['share_s'].sum() / 60:.0f} minutes, with twice as many discs."
    )


def other_runs(table):
    """Return sentences that compare the verdicts with the default run and with other root seeds."""
    with_seeds = dict(tuple(published_claims("docs/seeds.csv").groupby("seed")))
    # A run that was published before a criterion changed has no verdict by the new criterion.
    criteria = dict(zip(table["claim"], table["criterion"], strict=True))
    runs = [published_claims(DEFAULT_CLAIMS), *with_seeds.values()]
    runs = [run[run["claim"].map(criteria) == run["criterion"]] for run in runs]
    of_runs, differ = [overall(run) for run in runs], []
    for claim, verdict in overall(table).items():
        # A run that was published before a claim was added has no verdict on it.
        if others := {each.get(claim, verdict) for each in of_runs} - {verdict}:
            differ.append(f"{claim} ({', '.join(sorted(others))})")
    opposed = [f"{claim}, {case}" for claim, case in opposed_cases([table, *runs])]
    return (
        f"With the paper's own number of discs, 2880 (`make reproduce`, `{DEFAULT_CLAIMS}`), and also with "
        f"{len(with_seeds)} other root seeds ([seeds.csv](seeds.csv)), the verdicts are the same, but "
        f"for: {'; '.join(differ) or 'none'}. Cases that are reproduced in one of these runs and not reproduced in "
        f"another: {'; '.join(opposed) or 'none'}."
    )


def opposed_cases(runs):
    """Return [(claim, case)] that hold in one of several tables of verdicts and fail in another.

    Cases are compared without the numbers of a run in their names, such as the X of complete contact.
    """
    outcomes = defaultdict(set)
    for row in pd.concat(runs).itertuples():
        case = re.sub(r", from X = .*|, at X = .*| times [\d.]+$|, of \d+$", "", row.case)
        outcomes[row.claim, case].add(row.verdict)
    return [key for key, found in outcomes.items() if found & set(HELD) and "not reproduced" in found]


def sentences(table):
    """Return every checkable sentence of the paper with its origin and its verdicts, as a Markdown table."""
    verdicts, rows = verdicts_by_claim(table), []
    for sentence in read_paper(ROOT / "resources/paper", "sentences"):
        verdict = "; ".join(f"`{name}`: {verdicts[name]}" for name in sentence["claims"]) or "not judged"
        verdict += f": {sentence['why']}" if "why" in sentence else ""
        rows.append(f"| {sentence['where']} | {sentence['says']} | {sentence['origin']} | {verdict} |")
    return markdown_table("| where | what the paper says | origin | verdict |", rows)


def prefactors():
    """Return ζ of discs with a free exponent and with H/(1 + H), next to Eqs. 4 and 11, by Hurst exponent.

    The prefactor is not defined if the curve departs from the law with H/(1 + H) by more than the tolerance of ζ.
    """
    chosen = "source == 'discs' and case_group == 'base' and window_rule == 'default'"
    table = results("scaling").query(f"{chosen} and average == 'geometric' and rms_convention == 'disc'")
    table = table.set_index("hurst", drop=False)
    hurst, alpha = table["hurst"], exponent_alpha(table["hurst"])
    table = table.assign(alpha=alpha, eq_4=zeta_elastic(hurst), eq_11=zeta_viscous(hurst) * gamma_function(2 - alpha))
    return table.assign(defined=table["residual_fixed"] <= CLAIMS["zeta_viscous"]["tolerance"])


def prefactor_table():
    """Return the prefactors as a Markdown table."""
    table = prefactors()
    fixed = filled("{zeta_fixed:.2f} [{zeta_fixed_low:.2f}, {zeta_fixed_high:.2f}]", table)
    fixed = [text if met else f"not defined ({text})" for text, met in zip(fixed, table["defined"], strict=True)]
    row = "| {hurst:g} | {x_low:.2g} to {x_high:.2g} | {beta:.3f} [{beta_low:.3f}, {beta_high:.3f}] | {residual:.3f} "
    row += "| {zeta:.2f} [{zeta_low:.2f}, {zeta_high:.2f}] | {fixed} | {residual_fixed:.3f} "
    head = "| *H* | region (b), *X* | *β* free | residual | *ζ* at this *β* | *ζ* at *β* = *H*/(1 + *H*) | residual "
    head += "| Eq. 4 | Eq. 11 without Γ, (2 − *H*)Γ(2 − *α*) |"
    return markdown_table(head, filled(row + "| {eq_4:.2f} | {eq_11:.2f} |", table.assign(fixed=fixed)))


def constants():
    """Return a sentence with the constants that reconcile Eq. 12 with the discs from H = 0.4 on."""
    table = results("zeta_laws")
    chosen = (table["range"] == "region") & (table["law"] == LAST) & (table["hurst_min"] == table["hurst_min"].max())
    table = table[chosen].set_index("measure")
    texts = {name: f"{row.value:.2f} [{row.low:.2f}, {row.high:.2f}]" for name, row in table.iterrows()}
    left = table["value"]
    return (
        f"From *H* = {table['hurst_min'].iloc[0]:g} on, one constant for all *H* reconciles Eq. 12 with the discs in "
        f"region (b): a factor of {texts['common factor']} on *vt*/*h*, with a root mean square of "
        f"{left['residual']:.3f} in ln(*vt*/*h*), or a factor of {texts['factor of X']} on *X*, with "
        f"{left['residual with factor of X']:.3f}. As printed, without a constant, it is {left['deviation']:.3f} "
        "([zeta_laws.csv](results/zeta_laws.csv))."
    )


def fine_grids():
    """Return the sentence on fine grids, and their exponents as a Markdown table."""
    rows = fine_sentence.judged_rows(ROOT)
    row = (
        "| {hurst:g} | {x_low:.2g} | {beta:.3f} [{beta_low:.3f}, {beta_high:.3f}] | {limit_low:.3f} to "
        "{limit_high:.3f} | {expected:.3f} | {finding} | {power:.2f} |"
    )
    across = rows[0]["across"]
    tolerance = f"{fine_sentence.TOLERANCE:g}"
    head = f"| *H* | decade from *X* = | *β* on {across} | limit | *H*/(1 + *H*) | limit within {tolerance} | chance |"
    table = markdown_table(head, filled(row, pd.DataFrame(rows)))
    return paragraph(fine_sentence.fine_grids_sentence(rows)) + "\n" + table


def sufficient_models():
    """Return the cheapest sufficient model for every question and error as a Markdown table."""
    table = results("sufficient_models").fillna({"setting": ""})
    name = "`" + table["model"] + "`" + table["setting"].where(table["setting"] == "", ", " + table["setting"])
    table["named"] = name.where(table["reached"] == 1, "none measured; closest: " + name)
    table["time"] = table["processor_s"].map("{:.2g} s".format).where(table["processor_s"] > 0, "none")
    table["percent"], table["measured"] = 100 * table["allowed"], 100 * table["error"]
    head = "| question | error allowed | cheapest sufficient model | its error | processor time |"
    return markdown_table(head, filled("| {question} | {percent:g} % | {named} | {measured:.2g} % | {time} |", table))


def other_solver_times():
    """Return times of other solvers over the loading path, as a Markdown table by task and Hurst exponent."""
    ratios = pd.read_csv(ROOT / OTHER_SOLVERS).pivot_table("ratio", ["task", "elements", "hurst"], "solver", sort=False)
    first = filled("| {task} | {elements} | {hurst:g} |", ratios.index.to_frame())
    cells = ratios.map("{:.3g}".format).replace("nan", "–").agg(" | ".join, axis=1)
    rows = [f"{row} {rest} |" for row, rest in zip(first, cells, strict=True)]
    return markdown_table(f"| task | elements across | H | {' | '.join(ratios)} |", rows)


def large_maps():
    """Return the cost of discs on grids from coarse to fine as a Markdown table."""
    row = "| {across} | {wall:.3g} s | {wall_threads:.3g} s | {gigabytes:.1f} GB | {levels} | {operator_applications} |"
    head = "| elements across | one thread | two threads | memory | levels | operator applications |"
    return markdown_table(head, filled(row, results("large").eval("gigabytes = memory / 1e9")))


def published_results():
    """Return the contents of docs/results/ in Markdown: origins, figures and links to tables of every command."""
    records = json.loads((ROOT / "docs/results/published.json").read_text(encoding="utf-8"))
    commands, text = defaultdict(dict), []
    for name, record in records.items():
        commands[re.search(r"make ([\w-]+)", record["command"])[1]][name] = record
    for command, files in sorted(commands.items(), key=lambda item: -len(item[1])):
        links = defaultdict(list)
        for name, record in files.items():
            origin = "{command}, {date}, commit {commit}, {processor}, {cores} cores".format(**record)
            links[origin].append(f"[{name}](results/{name})")
        lines = [f"- {origin}: {', '.join(names)}" for origin, names in links.items()]
        pictures = [f"\n![{name.removesuffix('.png')}](results/{name})" for name in files if name.endswith(".png")]
        text += [f"### make {command}\n", *lines, *pictures, ""]
    return "\n".join(text)


# ---- numbers


def numbers():
    """Return {name: text} of all numbers in sentences."""
    value = published_claims().set_index(["claim", "case"])["value"]
    benchmarks = json.loads((ROOT / "docs/results/benchmarks.json").read_text(encoding="utf-8"))
    grids = results("one_surface").query(
        "quantity == 'velocity' and model == 'grid' and across == 257 and value == 1e-3"
    )
    on_grids = results("grid_dependence").query("quantity == 'κ at u/h = 1'").groupby("hurst")["factor"].max()
    law, failures = results("law_errors").query("across == 257 and x > 0.003"), results("failure_map")
    over_operator = [steps["whole"] for steps in benchmarks["over_operator"].values()]
    return {
        "default minutes": default_minutes(),
        "paper minutes": f"{costs()['share_s'].sum() / 60:.0f}",
        "mdr error": f"{100 * value['exact_correspondence'].abs().max():.0f}",
        "mdr error outside": f"{100 * value['whole_curve'].abs().max():.0f}",
        "line area": span(value["line_area"]),
        "line gap": span(value["line_gap"], 2),
        "grid and stiffness": listed(on_grids[[0.1, 0.4, 0.6]]),
        "stated failures": f"{wrong_without_warning(failures)[0]} of {len(failures)}",
        "law velocity": f"{100 * law['velocity_error'].abs().max():.0f}",
        "law interface": f"{100 * law['interface_error'].abs().max():.0f}",
        "law depth": f"{100 * law['depth_error'].abs().max():.0f}",
        "law and mean": span(errors_of_means("law"), 1),
        "mdr and mean": span(errors_of_means("MDR, λ = π", "MDR, λ fitted")),
        "coarse grid": span(100 * grids["error"]),
        "over operator": span(over_operator, 1),
        "one contact": f"{benchmarks['large_map']['contact']['wall_s']:.1f}",
    }


def errors_of_means(*models):
    """Return errors of the mean velocity over all Hurst exponents [%], with as many surfaces as there are."""
    table = results("mean_accuracy").query("quantity == 'velocity' and model in @models")
    return 100 * table.loc[table.groupby(["model", "hurst"])["surfaces"].idxmax(), "error"]


def first_minutes():
    """Return the times of the parts from the clone to the page, of all repeats at the commit measured last."""
    table = pd.read_csv(ROOT / FIRST_MINUTES)
    return table[table["commit"] == table["commit"].iloc[-1]]


def default_minutes():
    """Return the time from the clone to the page, or its range over the repeats, rounded up [min]."""
    minutes = np.ceil(first_minutes().groupby("repeat")["wall_s"].sum() / 60).astype(int)
    return " to ".join(map(str, sorted({minutes.min(), minutes.max()})))


# ---- tables and texts


def published_claims(name="docs/claims.csv"):
    table = pd.read_csv(ROOT / name, keep_default_na=False, na_values=[""])
    return table.assign(convention=table["convention"].astype(object).fillna(""))


def verdicts_by_claim(table):
    return {name: verdict_text(rows) for name, rows in table.groupby("claim", sort=False)}


def results(name):
    """Return a table of docs/results."""
    return pd.read_csv(ROOT / f"docs/results/{name}.csv")


def costs():
    return results("rule_costs").set_index("rule")


def span(values, places=0):
    """Return the smallest and the largest of some values as text."""
    return f"{np.min(values):.{places}f} to {np.max(values):.{places}f}"


def listed(values, form=".2f"):
    """Return numbers as text, with "and" before the last."""
    *first, last = (format(value, form) for value in values)
    return f"{', '.join(first)} and {last}"


def paragraph(text):
    """Return a paragraph in lines of at most 120 characters, none of which starts like an item of a list."""
    joined = re.sub(r" (?=[+*-] )", "\0", text)
    return textwrap.fill(joined, 120, break_long_words=False, break_on_hyphens=False).replace("\0", " ") + "\n"


def markdown_table(head, rows):
    """Return a Markdown table of these lines."""
    return "\n".join([head, "|---" * (head.count("|") - 1) + "|", *rows]) + "\n"


def filled(row, table):
    """Return a line of a Markdown table for each row of a DataFrame; row : template that names its columns"""
    return [row.format(**record) for record in table.to_dict("records")]
