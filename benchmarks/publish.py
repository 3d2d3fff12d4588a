"""Take verdicts, numbers, figures and tables from results into the project: README.md, docs/, the data of the package.

    python benchmarks/publish.py --results results

The results should be those of `make paper`, so that all published verdicts come from one run; those of `make seeds`,
`make speed`, `make stability`, `make sizes` and `make large` are taken as well where there are any. Without results
(`--pages-only`) only the tables in README.md and docs/verdicts.md are written, from docs/ and from the statements in
resources/paper/claims.yaml. The workflow writes only into results/.
"""

import json
import shutil
import subprocess
import textwrap
from datetime import UTC, datetime
from pathlib import Path

import click
import pandas as pd

from viscorough_study.paper_data import read_paper
from viscorough_study.performance import timing
from viscorough_study.verdicts import markdown, overall

ROOT = Path(__file__).resolve().parents[1]
BEGIN, END = "<!-- verdicts: by benchmarks/publish.py -->\n", "<!-- end of verdicts -->\n"
# {command: figures and tables in results/ that it makes and that are published in docs/results/}
PUBLISHED = {
    "make paper": (
        *("figures/fig1_surfaces.png", "figures/fig2_kinetics.png", "figures/fig3_master_curve.png"),
        *("figures/fig4_exponent.png", "figures/conventions.png", "figures/validation.png", "tables/scaling.csv"),
        *("tables/validation.csv", "tables/direct.csv", "tables/reduction.csv", "tables/rule_costs.csv", "costs.json"),
    ),
    "make speed": (
        *("figures/speed.png", "figures/growth.png", "figures/other_solvers.png", "figures/level_placement.png"),
        *("tables/methods.csv", "tables/other_solvers.csv", "tables/level_placement.csv"),
    ),
    "make stability": (
        *("figures/failure_map.png", "figures/failure_curves.png", "tables/failure_map.csv", "campaign.json"),
    ),
    "make sizes": ("figures/sizes.png", "tables/sizes.csv", "tables/sizes_trends.csv"),
    "make large": ("figures/large.png", "tables/large.csv"),
}
PICTURES = ("fig2_kinetics.png", "speed.png")  # which README.md shows: also in docs/


def verdicts():
    """The verdicts of docs/claims.csv with all numbers, as a table in Markdown, and how they depend on the seed."""
    table, seeds = published_claims(), ROOT / "docs/seeds.json"
    text = markdown(table, read_claims())
    return text + "\n" + other_seeds(overall(table), seeds) if seeds.is_file() else text


def verdict_lines():
    """The same without numbers, one line for each claim."""
    claims, lines = read_claims(), ["| the paper says | verdict |", "|---|---|"]
    for name, verdict in overall(published_claims()).items():
        lines.append(f"| {claims[name]['statement']} | {verdict} |")
    return "\n".join(lines) + "\n"


def published_claims():
    return pd.read_csv(ROOT / "docs/claims.csv", keep_default_na=False, na_values=[""])


def read_claims():
    return read_paper(ROOT / "resources/paper", "claims")


def other_seeds(published, seeds):
    """Sentence on a file seeds.json: the verdicts that change with the seed, and those that are not as published."""
    runs = json.loads(seeds.read_text(encoding="utf-8"))["verdicts"]
    outcomes = {claim: {run[claim] for run in runs.values()} for claim in published}
    change = "; ".join(f"{claim} ({', '.join(sorted(words))})" for claim, words in outcomes.items() if len(words) > 1)
    same = {claim: min(words) for claim, words in outcomes.items() if len(words) == 1}
    differ = "; ".join(f"{claim} ({word})" for claim, word in same.items() if word != published[claim])
    text = f"At the default scale with {len(runs)} root seeds (`make seeds`, [seeds.csv](seeds.csv)), verdicts"
    text += (
        f" that change with the seed: {change or 'none'}; verdicts that differ from those above: {differ or 'none'}."
    )
    return textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False) + "\n"


def write_tables():
    """Write the verdicts into README.md, a line each, and with all numbers into docs/verdicts.md."""
    for page, table in (("README.md", verdict_lines()), ("docs/verdicts.md", verdicts())):
        before, rest = (ROOT / page).read_text(encoding="utf-8").split(BEGIN)
        (ROOT / page).write_text(before + BEGIN + "\n" + table + "\n" + END + rest.split(END)[1], encoding="utf-8")


def copy_verdicts(results, project):
    """Copy claims, seeds and calibration from a folder of results to where the project keeps them."""
    shutil.copyfile(results / "tables/claims.csv", project / "docs/claims.csv")
    for seeds in results.glob("seeds.*"):
        shutil.copyfile(seeds, project / "docs" / seeds.name)
    shutil.copyfile(results / "tables/calibration.csv", project / "src/viscorough/data/calibration.csv")


def copy_files(results, project, commit):
    """Copy the published figures and tables that there are, and record where each comes from in published.json."""
    folder = project / "docs/results"
    folder.mkdir(exist_ok=True)
    record_file = folder / "published.json"
    records = json.loads(record_file.read_text(encoding="utf-8")) if record_file.is_file() else {}
    for command, names in PUBLISHED.items():
        for file in (results / name for name in names if (results / name).is_file()):
            shutil.copyfile(file, folder / file.name)
            if file.name in PICTURES:
                shutil.copyfile(file, project / "docs" / file.name)
            date = datetime.fromtimestamp(file.stat().st_mtime, UTC).date().isoformat()
            machine = timing.machine()
            about = {"processor": machine["processor"], "cores": machine["cores"], "commit": commit}
            records[file.name] = {"command": command, "date": date} | about
    record_file.write_text(json.dumps(records, indent=1, sort_keys=True) + "\n", encoding="utf-8")


@click.command(help=__doc__.splitlines()[0])
@click.option("--results", type=click.Path(path_type=Path), default=ROOT / "results", show_default=True)
@click.option("--pages-only", is_flag=True, help="Write README.md and docs/verdicts.md; take nothing from results.")
def main(results, pages_only):
    if not pages_only:
        if not (results / "tables/claims.csv").is_file():
            raise click.UsageError(f"{results}: no tables/claims.csv there; `make paper` makes it")
        copy_verdicts(results, ROOT)
        describe = ["git", "describe", "--always", "--dirty", "--exclude=*"]
        commit = subprocess.run(describe, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
        copy_files(results, ROOT, commit)
    write_tables()
    updated = "README.md and docs/verdicts.md" + ("" if pages_only else ", docs/, src/viscorough/data/calibration.csv")
    click.echo(f"written: {updated}")


if __name__ == "__main__":
    main()
