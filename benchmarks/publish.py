"""Take verdicts, numbers, figures and tables from results into the project: README.md, docs/, the data of the package.

    python benchmarks/publish.py --results results --command paper

Every command (`make paper`, `make speed`, ...) has its own figures and tables, which are copied into docs/results/ with
their origin. Name the commands whose results are in the folder: some of the files also exist at a smaller scale.
`paper` includes the verdicts and the calibrated power law, `law` the law of the interface, and `law-errors` its errors
and the intervals of single surfaces. `reproduce` includes the verdicts and the cost of the default run,
`first-minutes` the time from the clone to the page. `seeds` includes the dependence of the verdicts on the seed, which
draws the surfaces. With `--pages-only` only the tables in README.md and docs/ are written, from the last published
results and from the statements in resources/paper/claims.yaml. The workflow writes only into results/.
"""

import json
import re
import shutil
import subprocess
import textwrap
from collections import defaultdict
from datetime import UTC, datetime
from pathlib import Path

import click
import numpy as np
import pandas as pd
from measuring import write_json
from PIL import Image  # matplotlib depends on it
from scipy.special import gamma as gamma_function

from viscorough.law.calibrated_law import CONSTANTS
from viscorough.reference import exponent_alpha, exponent_beta, zeta_elastic, zeta_viscous
from viscorough_study.fits.zeta_laws import LAST
from viscorough_study.performance import timing
from viscorough_study.run.paper_data import read_paper
from viscorough_study.verdicts.answer import answer, short_answer
from viscorough_study.verdicts.claims import (
    HELD,
    counted_verdicts,
    findings,
    markdown,
    overall,
    verdict_text,
)
from viscorough_study.verdicts.region_criteria import SLOPES_OF_LINE

ROOT = Path(__file__).resolve().parents[1]
BEGIN, END = "<!-- {}: by benchmarks/publish.py -->\n", "<!-- end of {} -->\n"
OTHER_SOLVERS = "resources/published/other_solvers.csv"  # quoted by runs that do not measure other solvers
FIRST_MINUTES = "resources/published/first_minutes.csv"
DEFAULT_COSTS, DEFAULT_CLAIMS = "resources/published/default_costs.csv", "resources/published/default_claims.csv"


def _made(figures="", tables="", others=""):
    """Return files in results/ with these names of figures, names of tables, and other files."""
    figures, tables = (names.split() for names in (figures, tables))
    return [*(f"figures/{name}.png" for name in figures), *(f"tables/{name}.csv" for name in tables), *others.split()]


# {command of make: files that it makes in results/ and that docs/results/ publishes}
PUBLISHED = {
    "paper": _made(
        "fig1_surfaces fig2_kinetics fig3_master_curve fig4_exponent conventions validation interface reduction "
        "mdr_lambda",
        "scaling interface validation direct reduction rule_costs mdr_lambda mdr_summary mdr_exponents plateaus "
        "literature zeta_laws grid_dependence periodic",
    ),
    "speed": _made(
        "speed level_placement",
        "methods other_solvers level_placement one_surface mean_accuracy sufficient_models",
    ),
    "stability": _made("failures failure_map", "failure_map failure_knobs", "campaign.json"),
    "sizes": _made("sizes local_exponent", "sizes fine_exponents fine_velocities fine_costs"),
    "large": _made("large", "large"),
    "bench": ["benchmarks.json"],
    "outside": ["outside.csv"],
    "law": _made(tables="law"),
    "law-errors": _made(tables="law_errors"),
    "reproduce": [],
    "first-minutes": [],
    "seeds": [],
}
# {command: {file in results/ that other parts of the project read: its place there}}
KEPT = {
    "paper": {
        "tables/claims.csv": "docs/claims.csv",
        "tables/calibration.csv": "src/viscorough/law/data/calibration.csv",
    },
    "law": {"tables/law.csv": "src/viscorough/law/data/law.csv"},
    "law-errors": {"tables/law_scatter.csv": "src/viscorough/law/data/law_scatter.csv"},
    "reproduce": {
        "tables/rule_costs.csv": DEFAULT_COSTS,
        "tables/claims.csv": DEFAULT_CLAIMS,
    },
    "first-minutes": {"first_minutes.csv": FIRST_MINUTES},
    "seeds": {"seeds.csv": "docs/seeds.csv"},
}
CLAIMS = read_paper(ROOT / "resources/paper", "claims")
INTERFACE_QUANTITIES = {"whole": "*vt*/*h*", "interface": "*g*"}


def verdicts():
    """Return docs/claims.csv with all numbers as a Markdown table, and the verdicts of other runs that differ."""
    table = published_claims()
    return markdown(table, CLAIMS) + "\n" + paragraph(other_runs(table))


def other_runs(table):
    """Return sentences that compare the verdicts with the default run and, if published, with other root seeds."""
    runs, seeds, differ = [published_claims(DEFAULT_CLAIMS)], "", []
    if (ROOT / "docs/seeds.csv").is_file():
        with_seeds = dict(tuple(published_claims("docs/seeds.csv").groupby("seed")))
        runs += with_seeds.values()
        seeds = f" and also with {len(with_seeds)} other root seeds (`make seeds`, [seeds.csv](seeds.csv)),"
    # A run that was published before a criterion changed has no verdict by the new criterion.
    criteria = dict(zip(table["claim"], table["criterion"], strict=True))
    runs = [run[run["claim"].map(criteria) == run["criterion"]] for run in runs]
    of_runs = [overall(run) for run in runs]
    for claim, verdict in overall(table).items():
        # A run that was published before a claim was added has no verdict on it.
        if others := {each.get(claim, verdict) for each in of_runs} - {verdict}:
            differ.append(f"{claim} ({', '.join(sorted(others))})")
    opposed = [f"{claim}, {case}" for claim, case in opposed_cases([table, *runs])]
    return (
        f"With the paper's own number of discs, 2880 (`make reproduce`, `{DEFAULT_CLAIMS}`),{seeds} the verdicts are "
        f"the same, but for: {'; '.join(differ) or 'none'}. Cases that are reproduced in one of these runs and not "
        f"reproduced in another: {'; '.join(opposed) or 'none'}."
    )


def opposed_cases(runs):
    """Return [(claim, case)] that hold in one of several tables of verdicts and fail in another.

    Cases are compared without the numbers of a run in their names, such as the X of complete contact.
    """
    outcomes = {}
    for table in runs:
        for row in table.itertuples():
            case = re.sub(r", from X = .*|, at X = .*| times [\d.]+$|, of \d+$", "", row.case)
            outcomes.setdefault((row.claim, case), set()).add(row.verdict)
    return [key for key, found in outcomes.items() if found & set(HELD) and "not reproduced" in found]


def answer_lines():
    """Return the answer in one paragraph, the number of claims by verdict, and the findings that explain failures."""
    table = published_claims()
    failing = findings(table, CLAIMS)
    number = ["one finding", "two findings", "three findings", "four findings"][len(failing) - 1]
    text = f"{scoreboard()} The failures follow from {number}: {'; '.join(failing)}."
    return paragraph(f"**{answer(table)}**") + "\n" + paragraph(text)


def short_answer_lines():
    """Return the answer in three sentences, and the number of claims by verdict."""
    return paragraph(f"**{short_answer(published_claims())}**") + "\n" + paragraph(scoreboard())


# The main results: (claims whose verdicts are shown, what the paper says, what is found here with names of its numbers)
RESULTS = (
    (
        ["equivalence"],
        "the viscous problem is related to the elastic contact (Radok)",
        "equivalent while the contact grows",
    ),
    (["collapse"], "curves of all forces, viscosities, sizes and rms heights collapse", "one curve for each H"),
    (["beta"], "exponent β = H/(1 + H), “at least for H > 0.4”: {eq_beta}", "{beta} at H = 0.6 and 0.9"),
    (["beta_lines"], "the same exponent by the MDR", "from H = 0.4 on"),
    (
        ["exponent_limit"],
        "no claim for smaller H",
        "larger by {at_04:.2f} and {at_01:.2f} at H = 0.4 and 0.1; β is {fine} at smaller X on fine grids ({eq_fine})",
    ),
    (
        ["coincide"],
        "exponents of boundary elements and MDR “nearly coincide”",
        "differences {coincide} at H = 0.1, 0.4, 0.6 and 0.9",
    ),
    (["power_law"], "region (b) is nearly linear", "the slope varies by ± {spread}"),
    (["last_region", "separation"], "curves separate first at high H, and end on one line of slope 1", "so they do"),
    (["one_constant"], "all results collapse to one master curve (Fig. 3)", "from H = 0.4 on"),
    (
        ["master_curve"],
        "this curve is Eq. 12",
        "Eq. 12 times {factors[0]} (tolerance 15 %), or X times {factors[1]}; cause unknown",
    ),
    (
        ["zeta_viscous"],
        "ζ ≈ 2 − H with the factor Γ (Eq. 11): {eq_11_gamma}",
        "{zeta_gamma} at H = {hursts}",
    ),
    (["zeta_better"], "Eq. 11 fits better than Eq. 4", "so it does"),
    (
        ["gamma"],
        "a factor 1/Γ(2 − α) in Eqs. 7 to 9",
        "does not follow from Eqs. 1, 3 and 6; changes neither exponent nor collapse",
    ),
    (
        ["complete_contact"],
        "region (c) is an “almost complete” contact",
        "at its onset {wide} % in contact (slope within {slopes[0]:g} of 1), at the end of the curves {end} %",
    ),
)


def results_table():
    """Return the main results as a Markdown table."""
    verdict_by_claim = {name: verdict_text(rows) for name, rows in published_claims().groupby("claim", sort=False)}
    numbers, rows = found_numbers(), []
    for names, paper, here in RESULTS:
        # A run that was published before a claim was added has no verdict on it.
        verdict = "; ".join(dict.fromkeys(verdict_by_claim[name] for name in names if name in verdict_by_claim))
        rows.append(f"| {paper.format(**numbers)} | {here.format(**numbers)} | {verdict} |")
    return markdown_table("| the paper | here | verdict |", rows)


# What was found, as a numbered list: {number: text of the item, with the names of its numbers}.
FOUND = """
The viscous problem is equivalent to the elastic problem of the same surface, for every surface and force, as the paper
derives by Radok's principle. One elastic loading curve therefore gives the whole motion; to solve a contact problem in
every time step is not necessary ([theory](theory.md#the-correspondence)).

For each Hurst exponent H a single curve, vt/h = X/κ(X), holds for all forces, viscosities, sizes and rms heights.
Region (c) is for the paper an “almost complete” contact. It begins with {wide} % of the elements in contact if the
slope of the curves may differ from 1 by {slopes[0]:g}, and with {narrow} % at {narrow_hursts} if it may differ by
{slopes[1]:g}. At the end of the curves {end} % touch.

On the paper's grid the exponent β is within {within:.2f} of H/(1 + H) at H = 0.6 and 0.9. It is {at_04:.2f} and
{at_01:.2f} larger than H/(1 + H) at H = 0.4 and 0.1, where the paper makes no claim. There the exponent also depends on
the range of X, and finer grids give access to smaller X{limit}
([grid or surface](verification.md#grid-or-surface)).

From H = 0.4 on, the discs follow Eq. 12 up to one constant for all H: a factor of {factors[0]} on vt/h, or of
{factors[1]} on X. A root mean square of {residuals[0]:.0f} or {residuals[1]:.0f} % remains. At β = H/(1 + H) the
prefactor ζ is {zeta} at H = {hursts}. Eq. 4 says {eq_4}. Eq. 11 without the factor 1/Γ(2 − α) means {eq_11}. At H = 0.1
no law with this exponent describes the discs.

The factor 1/Γ(2 − α) in Eqs. 7 to 9 and 12 does not follow from the paper's Eqs. 1, 3 and 6, and neither direct
integration in time nor the paper's MDR has it. It changes neither the exponent nor the collapse
([theory](theory.md#the-factor-of-eqs-7-to-9)).

The MDR gives β = H/(1 + H) from H = 0.4 on. At H = 0.4 it differs from boundary elements by {coincide_04:.2f}, and by
{equal:.2f} if both are fitted in the same range of X. With one parameter fitted it gives mean velocities in region (b)
to {mdr:.0f} %, at a small part of the cost of boundary elements. Its “huge advantage” in time was larger in the paper,
where every time step of the boundary elements was a contact problem. It gives neither contact areas nor the motion of a
single surface ([explained](verification.md#the-reduction-of-dimensionality)).

Beyond the paper: the rough interface and the whole body act as two springs in series. Near X = 1 the stiffness of the
interface is F/({u0[0]:.2f} h) to F/({u0[1]:.2f} h), with the force F ([theory](theory.md#two-springs-in-series)).

On a grid of 257 elements across, `viscorough.indent` computes the motion to 0.1 % in about 0.1 s. A finer grid changes
the velocity by {grid} %. Other public solvers take {others[0]:.0f} to {others[1]} times as long
([performance](performance.md)).
"""


def found():
    """Return what was found, as a numbered list in Markdown."""
    items = FOUND.format(**found_numbers()).strip().split("\n\n")
    lines = [" ".join(f"{number}. {text}".split()) for number, text in enumerate(items, 1)]
    form = {"width": 120, "subsequent_indent": "   ", "break_long_words": False, "break_on_hyphens": False}
    return "".join(textwrap.fill(line, **form) + "\n" for line in lines)


def found_numbers():
    """Return the numbers of `FOUND`, {name: number or text}."""
    table = published_claims().set_index(["claim", "case"])["value"]
    fits, plateau = prefactors(), pd.read_csv(ROOT / "docs/results/interface.csv")
    above, contact = fits["beta"] - exponent_beta(fits.index), 100 * table["complete_contact"].dropna()
    wide, narrow = (contact[contact.index.str.contains(f"within {slope:g}")] for slope in SLOPES_OF_LINE)
    defined, constant = fits[fits["defined"]], table["one_constant"]
    errors = pd.read_csv(ROOT / "docs/results/one_surface.csv").query(
        "quantity == 'velocity' and model == 'grid' and across == 257 and value == 1e-3"
    )
    ratios = pd.read_csv(ROOT / OTHER_SOLVERS)["ratio"]
    fine = pd.read_csv(ROOT / "docs/results/fine_exponents.csv").query("judged == 1 and quantity == 'whole'")
    fine = fine[fine["hurst"].isin([0.1, 0.4])].sort_values("hurst", ascending=False)
    judged = published_claims().query("claim == 'exponent_limit'").dropna(subset="value")
    limit = filled("β = {value:.3f} [{low:.3f}, {high:.3f}] at {case} ({verdict})", judged)
    return {
        "limit": f": {'; '.join(limit)}" if limit else "",
        "wide": span(wide),
        "narrow": span(narrow),
        "narrow_hursts": of_hursts(narrow),
        "slopes": SLOPES_OF_LINE,
        "end": span(100 * table["complete_contact_end"]),
        "within": np.ceil(100 * above[[0.6, 0.9]].abs().max()) / 100,
        "at_04": above[0.4],
        "at_01": above[0.1],
        "factors": [case.split()[-1] for case in constant.index],
        "residuals": [100 * residual for residual in constant],
        "hursts": listed(defined.index, "g"),
        "zeta": listed(defined["zeta_fixed"]),
        "eq_4": listed(defined["eq_4"]),
        "eq_11": listed(defined["eq_11"]),
        "coincide": listed(table["coincide"], "+.2f"),
        "coincide_04": abs(table["coincide"]["H = 0.4"]),
        "beta": listed(table["beta"].to_numpy()[-2:], ".3f"),
        "spread": " to ± ".join(f"{end:.3f}" for end in table["power_law"].agg(["min", "max"])),
        "eq_beta": listed(exponent_beta(np.array([0.6, 0.9])), ".3f"),
        "eq_11_gamma": listed(zeta_viscous(defined.index.to_numpy()), ".1f"),
        "zeta_gamma": listed(defined["zeta_fixed"] / gamma_function(2 - defined["alpha"])),
        "fine": " and ".join(filled("{beta:.3f} [{beta_low:.3f}, {beta_high:.3f}]", fine)),
        "eq_fine": listed(fine["expected"], ".3f"),
        "equal": abs(table["coincide_equal_windows"]["H = 0.4, same X"]),
        "mdr": 100 * table["exact_correspondence"].abs().max(),
        "u0": plateau.query("source == 'discs' and across == 257")["u0"].agg(["min", "max"]).tolist(),
        "grid": span(100 * errors["error"]),
        "others": (ratios.min(), 10 * round(ratios.max() / 10)),
    }


def span(values):
    """Return the smallest and the largest of some values as text, without decimals."""
    return f"{min(values):.0f} to {max(values):.0f}"


def listed(values, form=".2f"):
    """Return numbers as text, with "and" before the last."""
    *first, last = (format(value, form) for value in values)
    return f"{', '.join(first)} and {last}"


def of_hursts(cases):
    """Return the range of Hurst exponents of cases, such as "H = 0.4 to 0.9"."""
    hursts = [float(case.removeprefix("H = ").split(",")[0]) for case in cases.index]
    return f"H = {min(hursts):g} to {max(hursts):g}"


def scoreboard():
    """Return the numbers of claims by verdict, own and quoted apart, of the published run and of the default run."""
    texts = []
    for name in ("docs/claims.csv", DEFAULT_CLAIMS):
        totals = [counted_verdicts(published_claims(name), origin) for origin in ("own", "quoted")]
        own, quoted = (", ".join(f"{number} {verdict}" for verdict, number in total) for total in totals)
        texts.append(f"own claims of the paper on physics: {own}; quoted claims: {quoted}")
    here, default = texts
    text = f"Verdicts (`{origin_of('scaling.csv')['command']}`), {here}."
    verdicts = overall(published_claims())
    prefactor = [name for name in ("gamma", "zeta_viscous", "master_curve") if verdicts[name] == "not reproduced"]
    if len(prefactor) > 1:
        text += f" {len(prefactor)} of its own claims that are not reproduced concern the one prefactor."
    text += " Statements that hold by construction are not counted."
    if default != here:
        text += f" The default run (`make reproduce`) has {default}."
    return text


def origin_of(name):
    """Return the command, date and commit with which a file of docs/results was made."""
    return json.loads((ROOT / "docs/results/published.json").read_text(encoding="utf-8"))[name]


def disc_fits():
    """Return the published fits of discs, in the conventions of the figures, by Hurst exponent."""
    table = pd.read_csv(ROOT / "docs/results/scaling.csv")
    chosen = "source == 'discs' and case_group == 'base' and window_rule == 'default'"
    table = table.query(f"{chosen} and average == 'geometric' and rms_convention == 'disc'")
    return table.set_index("hurst", drop=False)


def prefactors():
    """Return ζ with a free exponent and with H/(1 + H), next to Eqs. 4 and 11, by Hurst exponent.

    The prefactor is not defined if the curve departs from the law with H/(1 + H) by more than the tolerance of ζ.
    """
    table = disc_fits()
    hurst, alpha = table["hurst"], exponent_alpha(table["hurst"])
    eq_11 = zeta_viscous(hurst) * gamma_function(2 - alpha)
    table = table.assign(alpha=alpha, eq_4=zeta_elastic(hurst), eq_11=eq_11)
    table["defined"] = table["residual_fixed"] <= CLAIMS["zeta_viscous"]["tolerance"]
    table["if_radius"] = 2 ** (1 - alpha) * table["zeta_fixed"] / eq_11
    return table


def prefactor_table():
    """Return the prefactors as a Markdown table, and the constants that reconcile Eq. 12 with the discs."""
    head = "| *H* | region (b), *X* | *β* free | residual | *ζ* at this *β* | *ζ* at *β* = *H*/(1 + *H*) | residual "
    head += "| Eq. 4 | Eq. 11 without Γ, (2 − *H*)Γ(2 − *α*) |"
    row = "| {hurst:g} | {x_low:.2g} to {x_high:.2g} | {beta:.3f} [{beta_low:.3f}, {beta_high:.3f}] | {residual:.3f} "
    row += (
        "| {zeta:.2f} [{zeta_low:.2f}, {zeta_high:.2f}] | {fixed} | {residual_fixed:.3f} | {eq_4:.2f} | {eq_11:.2f} |"
    )
    table = prefactors()
    fixed = filled("{zeta_fixed:.2f} [{zeta_fixed_low:.2f}, {zeta_fixed_high:.2f}]", table)
    fixed = [text if met else f"not defined ({text})" for text, met in zip(fixed, table["defined"], strict=True)]
    rows = filled(row, table.assign(fixed=fixed))
    return markdown_table(head, rows) + "\n" + paragraph(constants())


def constants():
    """Return a sentence with the constants that reconcile Eq. 12 with the discs from H = 0.4 on."""
    table = pd.read_csv(ROOT / "docs/results/zeta_laws.csv")
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


def first_minutes():
    """Table of the parts from the clone to the page, of all repeats with the commit that was measured last."""
    table = pd.read_csv(ROOT / FIRST_MINUTES)
    return table[table["commit"] == table["commit"].iloc[-1]]


def default_minutes():
    """Return the time from the clone to the page, or its range over the repeats."""
    minutes = first_minutes().groupby("repeat")["wall_s"].sum().div(60).round().astype(int)
    return f"{' to '.join(map(str, sorted({minutes.min(), minutes.max()})))} minutes"


def sentences():
    """Return every checkable sentence of the paper with its origin and its verdicts, as a Markdown table."""
    table = published_claims()
    verdict_by_claim = {name: verdict_text(rows) for name, rows in table.groupby("claim", sort=False)}
    rows = []
    for sentence in read_paper(ROOT / "resources/paper", "sentences"):
        judged = "; ".join(f"`{name}`: {verdict_by_claim[name]}" for name in sentence["claims"])
        verdict = judged or "not judged"
        verdict += f": {sentence['why']}" if "why" in sentence else ""
        rows.append(f"| {sentence['where']} | {sentence['says']} | {sentence['origin']} | {verdict} |")
    return markdown_table("| where | what the paper says | origin | verdict |", rows)


def time_sentence():
    """Return a sentence on the times of the default run and of the paper, with machine and date."""
    table = first_minutes()
    seconds = table.groupby("part")["wall_s"].median()
    machine, measured = table[["machine", "measured"]].iloc[-1]
    weeks = read_paper(ROOT / "resources/paper", "numbers")["boundary_elements"]["computing_time"]["value"]
    text = (
        f"**{weeks.capitalize()} in the paper, {default_minutes()} here**: from `git clone` to the page on a virtual "
    )
    text += f"machine ({machine}, {measured}), with as many discs as the paper up to X = 1.8, and with fewer and "
    text += (
        f"shorter lines; {seconds['environment'] + seconds['compilation']:.0f} seconds of this are needed only once."
    )
    return paragraph(text)


def published_claims(name="docs/claims.csv"):
    table = pd.read_csv(ROOT / name, keep_default_na=False, na_values=[""])
    return table.assign(convention=table["convention"].astype(object).fillna(""))


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


def with_ratios(first, table):
    """Return a Markdown table of these first cells, then a ratio of three digits for each column, or a dash."""
    names = [name if isinstance(name, str) else f"{name[0]}, {name[1]} thread{'s' * (name[1] > 1)}" for name in table]
    cells = table.map("{:.3g}".format).replace("nan", "–").agg(" | ".join, axis=1)
    head, *rows = first
    rows = [f"{row} {rest} |" for row, rest in zip(rows, cells, strict=True)]
    return markdown_table(f"{head} {' | '.join(names)} |", rows)


def other_solver_times():
    """Return times of other solvers over the loading path, as a Markdown table by task and Hurst exponent."""
    table = pd.read_csv(ROOT / OTHER_SOLVERS)
    ratios = table.pivot_table("ratio", ["task", "elements", "hurst"], "solver", sort=False)
    rows = filled("| {task} | {elements} | {hurst:g} |", ratios.index.to_frame())
    return with_ratios(["| task | elements across | H |", *rows], ratios)


def large_maps():
    """Return the cost of discs on grids from coarse to fine, as a Markdown table."""
    table = pd.read_csv(ROOT / "docs/results/large.csv").eval("gigabytes = memory / 1e9")
    row = "| {across} | {wall:.3g} s | {wall_threads:.3g} s | {gigabytes:.1f} GB | {levels} | {operator_applications} |"
    head = "| elements across | one thread | two threads | memory | levels | operator applications |"
    return markdown_table(head, filled(row, table))


def sufficient_models():
    """The cheapest sufficient model for every question and error, as a table in Markdown."""
    table = pd.read_csv(ROOT / "docs/results/sufficient_models.csv").fillna({"setting": ""})
    reached = table["reached"] == 1
    name = "`" + table["model"] + "`" + table["setting"].where(table["setting"] == "", ", " + table["setting"])
    table["named"] = name.where(reached, "none measured; closest: " + name)
    table["time"] = table["processor_s"].map("{:.2g} s".format).where(table["processor_s"] > 0, "none")
    table["percent"], table["measured"] = 100 * table["allowed"], 100 * table["error"]
    head = "| question | error allowed | cheapest sufficient model | its error | processor time |"
    return markdown_table(head, filled("| {question} | {percent:g} % | {named} | {measured:.2g} % | {time} |", table))


def requested_errors():
    """Errors and cost of curves to a requested error, as a table in Markdown."""
    table = pd.read_csv(ROOT / "docs/results/one_surface.csv").query("quantity == 'velocity'")
    full = table.query("model == 'grid' and across == across.max()").set_index("hurst")["processor_s"]
    rows = table.query("model == 'requested error'").sort_values(["value", "hurst"], ascending=[False, True])
    rows = rows.assign(over=rows["processor_s"] / rows["hurst"].map(full))
    for name in ("value", "error", "stated"):
        rows[name] *= 100
    head = "| request | H | points across, of 513, median | error | stated | processor time "
    head += "| over the full curve with `--grid-error` |"
    line = "| `--error {value:g}%` | {hurst:g} | {across:g} | {error:.2g} % | {stated:.2g} % "
    line += "| {processor_s:.2g} s | {over:.2g} |"
    return markdown_table(head, filled(line, rows))


def outside_numbers():
    """Return published numbers next to ours, from docs/results/outside.csv, as a Markdown table."""
    table = pd.read_csv(ROOT / "docs/results/outside.csv")
    table["quantity"] = table["quantity"].str.replace("*", r"\*")
    table["exceeded"] = table["met"].map({0: ", **exceeded**", 1: ""})
    row = "| {half_space} | {quantity} | {published:.4g} | {ours:.4g} | {deviation:+.2g} | {tolerance:.2g}{exceeded} "
    head = "| half-space | quantity | published | ours | deviation | allowed | reason, source |"
    return markdown_table(head, filled(row + "| {reason}; {source} |", table))


def fine_grids():
    """Return exponents of fine grids from docs/results/fine_exponents.csv, and their costs, as two Markdown tables."""
    table = pd.read_csv(ROOT / "docs/results/fine_exponents.csv").query("judged == 1")
    names = ["beta", "limit"]
    cells = {name: filled(f"{{{name}:.3f}} [{{{name}_low:.3f}}, {{{name}_high:.3f}}]", table) for name in names}
    rows = [
        f"| {row.hurst:g} | {INTERFACE_QUANTITIES[row.quantity]} | {row.x_low:.2g} | {row.across} | {beta} | "
        f"{'not determined' if pd.isna(row.limit) else limit} | {row.expected:.3f} | {row.finding} |"
        for row, beta, limit in zip(table.itertuples(), cells["beta"], cells["limit"], strict=True)
    ]
    head = "| *H* | quantity | decade from *X* = | elements across | *β* on this grid | limit of fine grids "
    exponents = markdown_table(head + "| *H*/(1 + *H*) | finding |", rows)
    costs = pd.read_csv(ROOT / "docs/results/fine_costs.csv").drop_duplicates(["hurst", "x_low"])
    line = "| {hurst:g} | {x_low:.2g} | {base} | {half_width:.3f} | {sum_s:.0f} s | {plain_s:.0f} s "
    line += "| {cost_ratio:.2f} |"
    head = "| *H* | decade from *X* = | sum from grid | half-width of *β* | sum over pairs | plain average | ratio |"
    return exponents + "\n" + markdown_table(head, filled(line, costs))


def interface_law():
    """Return the law of two springs for each Hurst exponent and grid, of data/law.csv, as two Markdown tables."""
    table = pd.read_csv(ROOT / KEPT["law"]["tables/law.csv"]).sort_values(["across", "hurst"], ascending=[False, True])
    fractions = ["deviation", "unadjusted", "standard_error", "geometric_velocity", "geometric_depth"]
    table[fractions] *= 100
    head = "| *H* | elements across | *A* | *b* | *s* | *m* | *d* | ∫*g* d ln *X* | ∫*g* d*X* |"
    interval = " {{{0}:.3g}} [{{{0}_low:.3g}}, {{{0}_high:.3g}}] |"
    row = "| {hurst:g} | {across:g} |" + "".join(map(interval.format, (*CONSTANTS, "mean_gap", "energy")))
    constants = markdown_table(head, filled(row, table))
    head = "| *H* | elements across | discs, other discs | law of *g* within 5 % for *X* | largest deviation of *g* "
    head += "| without control variates | standard error | geometric mean of *vt*/*h* lower by | of *u*/*h* |"
    row = "| {hurst:g} | {across:g} | {discs:g}, {unused:g} | {x_low:.2g} to {x_high:.3g} |"
    row += "".join(map(" {{{}:.1f}} % |".format, fractions))
    return constants + "\n" + markdown_table(head, filled(row, table))


def largest_errors():
    """Return the largest errors of the law from X = 0.003 to 13, and shares of discs in their interval.

    There is one row for each H and grid. Shares are the mean over X, and the smallest and the largest at one X.
    """
    rows = []
    judged = pd.read_csv(ROOT / "docs/results/law_errors.csv").query("x > 0.003")
    for (hurst, across), table in judged.groupby(["hurst", "across"]):
        row = {"hurst": hurst, "across": across, **table[["discs", "tested"]].iloc[0]}
        for name in ("velocity", "interface", "depth"):
            worst = table.loc[table[f"{name}_error"].abs().idxmax()]
            row |= {name: worst[f"{name}_error"], f"{name}_standard": worst[f"{name}_standard_error"]}
            row[f"{name}_x"] = worst["x"]
        for name in ("velocity", "depth"):
            shares = table[f"{name}_coverage"].agg(["mean", "min", "max"])
            row |= {f"{name}_coverage": shares["mean"], f"{name}_least": shares["min"], f"{name}_most": shares["max"]}
        rows.append(row)
    return pd.DataFrame(rows)


def law_errors():
    """Return the largest errors of the law on fresh discs, and shares of discs in their interval, as two tables."""
    table = largest_errors().sort_values(["across", "hurst"], ascending=[False, True])
    row, head = "| {hurst:g} | {across:g} | {discs:g} |", "| *H* | elements across | discs |"
    for name, text in {"velocity": "*vt*/*h*", "interface": "*g*", "depth": "*u*/*h*"}.items():
        row += f" {{{name}:+.1%}} ± {{{name}_standard:.1%}} at {{{name}_x:.2g}} |"
        head += f" {text}: error ± standard error at *X* |"
    errors = markdown_table(head, filled(row, table)).replace("%", " %").replace("| -", "| −")
    row, head = "| {hurst:g} | {across:g} | {tested:g} |", "| *H* | elements across | discs |"
    for name, text in {"velocity": "*vt*/*h*", "depth": "*u*/*h*"}.items():
        row += f" {{{name}_coverage:.1%}}, {{{name}_least:.1%}} to {{{name}_most:.1%}} |"
        head += f" {text}: mean over *X*, least to most |"
    shares = markdown_table(head, filled(row, table[table["tested"] > 0])).replace("%", " %")
    caption = "Shares of single discs that lie in the interval of a single surface, nominally 95 %:"
    return f"{errors}\n{caption}\n\n{shares}"


def _origin_text(record):
    """Return the command, date, commit and machine of a record of docs/results/published.json."""
    command = f"`{record['command']}`" if record["command"].startswith("make ") else record["command"]
    return f"{command}, " + "{date}, commit {commit}, {processor}, {cores} cores".format(**record)


def published_results(records):
    """Return the contents of docs/results/ in Markdown: origins, figures and links to tables of every command.

    The first origin holds for most files; further origins name their files.
    records : content of docs/results/published.json
    """
    text = []
    for command, names in PUBLISHED.items():
        files = [file for file in (Path(name) for name in names) if file.name in records]
        figures, tables = ([file for file in files if (file.suffix == ".png") == shown] for shown in (True, False))
        pictures = [f"![{file.stem.replace('_', ' ')}](results/{file.name})\n" for file in figures]
        links = [f"- [{file.name}](results/{file.name})" for file in tables]
        origins = defaultdict(list)
        for file in files:
            origins[_origin_text(records[file.name])].append(f"`{file.name}`")
        if files:
            most = max(origins, key=lambda origin: len(origins[origin]))
            others = [f"{', '.join(names)}: {origin}." for origin, names in origins.items() if origin != most]
            lines = map(paragraph, [f"{most}.", *others])
            text += [f"## make {command}\n", *lines, *pictures, "Files:", *links, ""]
    return "\n".join(text)


def tables():
    """Return {(page, name): text} of the generated parts, between marks, of README.md and pages of docs/."""
    records = json.loads((ROOT / "docs/results/published.json").read_text(encoding="utf-8"))
    return {
        ("README.md", "answer"): short_answer_lines(),
        ("docs/index.md", "answer"): answer_lines(),
        ("docs/verdicts.md", "answer"): answer_lines(),
        ("docs/verdicts.md", "sentences"): sentences(),
        ("README.md", "results"): results_table(),
        ("docs/index.md", "findings"): found(),
        ("README.md", "time"): time_sentence(),
        ("docs/verdicts.md", "verdicts"): verdicts(),
        ("docs/performance.md", "sufficient models"): sufficient_models(),
        ("docs/performance.md", "requested errors"): requested_errors(),
        ("docs/performance.md", "other solvers"): other_solver_times(),
        ("docs/performance.md", "large maps"): large_maps(),
        ("docs/outside.md", "outside"): outside_numbers(),
        ("docs/theory.md", "prefactors"): prefactor_table(),
        ("docs/scaling.md", "fine grids"): fine_grids(),
        ("docs/theory.md", "interface law"): interface_law(),
        ("docs/verification.md", "law errors"): law_errors(),
        ("docs/published.md", "results"): published_results(records),
    }


def write_tables():
    """Write the generated parts between their marks."""
    for (page, name), table in tables().items():
        begin, end = BEGIN.format(name), END.format(name)
        before, rest = (ROOT / page).read_text(encoding="utf-8").split(begin)
        (ROOT / page).write_text(before + begin + "\n" + table + "\n" + end + rest.split(end)[1], encoding="utf-8")


def copy_other_solvers(table, target, machine, date):
    """Write the times of other solvers on one thread over the time of the path, with date and machine.

    Solutions that do not meet the residual have no time.
    """
    times = pd.read_csv(table).query("solver != 'viscorough' and threads == 1").dropna(subset="ratio")
    times = times[["task", "hurst", "elements", "levels", "solver", "version", "threads", "ratio"]]
    times = times.assign(ratio=times["ratio"].map("{:.3g}".format), measured=date, machine=machine)
    times.to_csv(target, index=False, lineterminator="\n")


def date_of(file):
    """Return the day on which a file was made."""
    return datetime.fromtimestamp(file.stat().st_mtime, UTC).date().isoformat()


def copy_picture(file, target):
    """Copy a PNG file with at most 128 colours, which needs a third of the bytes: git keeps every version."""
    with Image.open(file) as picture:
        picture.convert("RGB").quantize(128, dither=Image.Dither.NONE).save(target, optimize=True)


def copy_table(file, target):
    """Copy a CSV file with eight significant digits, which needs half of the bytes: git keeps every version."""
    text = pd.read_csv(file, keep_default_na=False, na_values=[""])
    text.to_csv(target, index=False, float_format="%.8g", lineterminator="\n")


def copy_results(results, project, commands, commit):
    """Copy the results of the commands, and record the origin of each figure and table in docs/results/published.json.

    Raises ClickException, before anything is copied, if a file is missing.
    """
    for command in commands:
        for name in (*PUBLISHED[command], *KEPT.get(command, {})):
            if not (results / name).is_file():
                raise click.ClickException(f"{results}: no {name} there; `make {command}` makes it")
    folder, machine = project / "docs/results", timing.machine()
    folder.mkdir(exist_ok=True)
    record_file = folder / "published.json"
    records = json.loads(record_file.read_text(encoding="utf-8")) if record_file.is_file() else {}
    origin = {"processor": machine["processor"], "cores": machine["cores"], "commit": commit}
    where = f"{machine['processor']}, {machine['cores']} cores"
    for command in commands:
        for name, target in KEPT.get(command, {}).items():
            shutil.copyfile(results / name, project / target)
            if target == DEFAULT_COSTS:
                costs = pd.read_csv(results / name).assign(measured=date_of(results / name), machine=where)
                costs.to_csv(project / target, index=False, lineterminator="\n")
        for file in (results / name for name in PUBLISHED[command]):
            copy = {".png": copy_picture, ".csv": copy_table}.get(file.suffix, shutil.copyfile)
            copy(file, folder / file.name)
            records[file.name] = {"command": f"make {command}", "date": date_of(file)} | origin
            if file.name == "other_solvers.csv":
                copy_other_solvers(file, project / OTHER_SOLVERS, where, date_of(file))
    write_json(dict(sorted(records.items())), record_file)


@click.command(help=__doc__.splitlines()[0])
@click.option("--results", type=click.Path(path_type=Path), default=ROOT / "results", show_default=True)
@click.option("--command", "commands", type=click.Choice(list(PUBLISHED)), multiple=True, default=["paper"])
@click.option(
    "--pages-only", is_flag=True, help="Write only the tables in README.md and docs/; take nothing from results."
)
def main(results, commands, pages_only):
    if not pages_only:
        describe = ["git", "describe", "--always", "--dirty", "--exclude=*"]
        commit = subprocess.run(describe, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
        copy_results(results, ROOT, commands, commit)
    write_tables()
    click.echo("written: tables in README.md and docs/" + ("" if pages_only else f", what {', '.join(commands)} made"))


if __name__ == "__main__":
    main()
