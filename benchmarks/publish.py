"""Take verdicts and calibrated numbers from results into the project: docs/, README.md, the package's data.

    python benchmarks/publish.py --results results

What `make paper` has made should be published, so that all are of one run; what `make seeds` has made is taken along.
The workflow writes only results.
"""

import json
import shutil
import textwrap
from pathlib import Path

import click
import pandas as pd
import yaml

from viscorough_study.verdicts import markdown, overall

ROOT = Path(__file__).resolve().parents[1]
SEEDS = ROOT / "docs/seeds.json"
BEGIN, END = "<!-- verdicts: by benchmarks/publish.py -->\n", "<!-- end of verdicts -->\n"


def verdicts():
    """The table of docs/claims.csv in Markdown, and what docs/seeds.json says about other root seeds."""
    claims = yaml.safe_load((ROOT / "resources/paper/claims.yaml").read_text(encoding="utf-8"))
    table = pd.read_csv(ROOT / "docs/claims.csv", keep_default_na=False, na_values=[""])
    text = markdown(table, claims)
    return text + "\n" + seeds(overall(table)) if SEEDS.is_file() else text


def seeds(published):
    """What docs/seeds.json says: the verdicts that move, and those that are not the published ones."""
    found = json.loads(SEEDS.read_text(encoding="utf-8"))
    every = {name: {each[name] for each in found["verdicts"].values()} for name in published}
    moved = "; ".join(f"{name} ({', '.join(sorted(words))})" for name, words in every.items() if len(words) > 1)
    same = {name: min(words) for name, words in every.items() if len(words) == 1}
    other = "; ".join(f"{name} ({word})" for name, word in same.items() if word != published[name])
    number, link = len(found["verdicts"]), "[docs/seeds.csv](docs/seeds.csv)"
    text = f"At the default scale with {number} root seeds (`make seeds`, {link}): verdicts that move with the seed: "
    text += f"{moved or 'none'}; other verdicts than those above: {other or 'none'}."
    return textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False) + "\n"


@click.command(help=__doc__.splitlines()[0])
@click.option("--results", type=click.Path(exists=True, path_type=Path), default=ROOT / "results", show_default=True)
def main(results):
    shutil.copyfile(results / "tables/claims.csv", ROOT / "docs/claims.csv")
    if (results / "seeds.json").is_file():
        shutil.copyfile(results / "seeds.json", SEEDS)
        shutil.copyfile(results / "seeds.csv", ROOT / "docs/seeds.csv")
    data = ROOT / "src/viscorough/data"
    data.mkdir(exist_ok=True)
    shutil.copyfile(results / "tables/calibration.csv", data / "calibration.csv")
    readme = ROOT / "README.md"
    before, rest = readme.read_text(encoding="utf-8").split(BEGIN)
    readme.write_text(before + BEGIN + "\n" + verdicts() + "\n" + END + rest.split(END)[1], encoding="utf-8")
    click.echo("docs/claims.csv, src/viscorough/data/calibration.csv and README.md have these verdicts and numbers")


if __name__ == "__main__":
    main()
