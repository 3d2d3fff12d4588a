"""Take verdicts and calibrated numbers from results into the project: docs/claims.csv, README.md, the package's data.

    python benchmarks/publish.py --results results

What `make paper` has made should be published, so that all three are of one run. The workflow writes only results.
"""

import shutil
from pathlib import Path

import click
import pandas as pd
import yaml

from viscorough.claims import markdown

ROOT = Path(__file__).resolve().parents[1]
BEGIN, END = "<!-- verdicts: by benchmarks/publish.py -->\n", "<!-- end of verdicts -->\n"


def verdicts():
    """The table of docs/claims.csv in Markdown."""
    claims = yaml.safe_load((ROOT / "resources/paper/claims.yaml").read_text(encoding="utf-8"))
    return markdown(pd.read_csv(ROOT / "docs/claims.csv", keep_default_na=False, na_values=[""]), claims)


@click.command(help=__doc__.splitlines()[0])
@click.option("--results", type=click.Path(exists=True, path_type=Path), default=ROOT / "results", show_default=True)
def main(results):
    shutil.copyfile(results / "tables/claims.csv", ROOT / "docs/claims.csv")
    data = ROOT / "src/viscorough/data"
    data.mkdir(exist_ok=True)
    shutil.copyfile(results / "tables/calibration.csv", data / "calibration.csv")
    readme = ROOT / "README.md"
    before, rest = readme.read_text(encoding="utf-8").split(BEGIN)
    readme.write_text(before + BEGIN + "\n" + verdicts() + "\n" + END + rest.split(END)[1], encoding="utf-8")
    click.echo("docs/claims.csv, src/viscorough/data/calibration.csv and README.md have these verdicts and numbers")


if __name__ == "__main__":
    main()
