"""Take verdicts and calibrated numbers from results into the project: docs/, README.md, the data of the package.

    python benchmarks/publish.py --results results

The results should be those of `make paper`, so that all published numbers come from one run; those of `make seeds` are
taken as well where there are any. Without results (`--readme-only`) only README.md is written, from docs/ and from the
statements in resources/paper/claims.yaml. The workflow writes only into results/.
"""

import json
import shutil
import textwrap
from pathlib import Path

import click
import pandas as pd

from viscorough_study.paper_data import read_paper
from viscorough_study.verdicts import markdown, overall

ROOT = Path(__file__).resolve().parents[1]
CLAIMS, SEEDS = ROOT / "docs/claims.csv", ROOT / "docs/seeds.json"
BEGIN, END = "<!-- verdicts: by benchmarks/publish.py -->\n", "<!-- end of verdicts -->\n"


def verdicts():
    """The verdicts of docs/claims.csv as a table in Markdown, and how they change with the root seed."""
    claims = read_paper(ROOT / "resources/paper", "claims")
    table = pd.read_csv(CLAIMS, keep_default_na=False, na_values=[""])
    text = markdown(table, claims)
    return text + "\n" + other_seeds(overall(table)) if SEEDS.is_file() else text


def other_seeds(published):
    """Sentence on docs/seeds.json: the verdicts that change with the root seed, and those that are not as published."""
    runs = json.loads(SEEDS.read_text(encoding="utf-8"))["verdicts"]
    outcomes = {claim: {run[claim] for run in runs.values()} for claim in published}
    change = "; ".join(f"{claim} ({', '.join(sorted(words))})" for claim, words in outcomes.items() if len(words) > 1)
    same = {claim: min(words) for claim, words in outcomes.items() if len(words) == 1}
    differ = "; ".join(f"{claim} ({word})" for claim, word in same.items() if word != published[claim])
    text = (
        f"At the default scale with {len(runs)} root seeds (`make seeds`, [docs/seeds.csv](docs/seeds.csv)), verdicts"
    )
    text += (
        f" that change with the seed: {change or 'none'}; verdicts that differ from those above: {differ or 'none'}."
    )
    return textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False) + "\n"


def copy_results(results):
    """Copy claims, seeds and calibration from a folder of results to where the project keeps them."""
    shutil.copyfile(results / "tables/claims.csv", CLAIMS)
    if (results / "seeds.json").is_file():
        shutil.copyfile(results / "seeds.json", SEEDS)
        shutil.copyfile(results / "seeds.csv", SEEDS.with_suffix(".csv"))
    shutil.copyfile(results / "tables/calibration.csv", ROOT / "src/viscorough/data/calibration.csv")


@click.command(help=__doc__.splitlines()[0])
@click.option("--results", type=click.Path(path_type=Path), default=ROOT / "results", show_default=True)
@click.option("--readme-only", is_flag=True, help="Write README.md from docs/, and take nothing from results.")
def main(results, readme_only):
    if not readme_only:
        if not (results / "tables/claims.csv").is_file():
            raise click.UsageError(f"{results}: no tables/claims.csv there; `make paper` makes it")
        copy_results(results)
    readme = ROOT / "README.md"
    before, rest = readme.read_text(encoding="utf-8").split(BEGIN)
    readme.write_text(before + BEGIN + "\n" + verdicts() + "\n" + END + rest.split(END)[1], encoding="utf-8")
    updated = "README.md" if readme_only else "docs/claims.csv, src/viscorough/data/calibration.csv and README.md"
    click.echo(f"written: {updated}")


if __name__ == "__main__":
    main()
