"""Copy figures, claims and the table of verdicts from results into the project.

    python benchmarks/publish.py --verdicts regions

Name only figures at the scale to be published: `make reproduce` also makes `speed` and `failures`, at a smaller scale.
"""

from pathlib import Path

import click
from PIL import Image  # matplotlib depends on it

from viscorough_study.run.tables import split_table

ROOT = Path(__file__).resolve().parents[1]


def copy_figure(file, target):
    """Copy a PNG file: git keeps every version, so figures without a colour map get at most 128 colours."""
    with Image.open(file) as picture:
        if picture.mode == "P":  # save_figure keeps all colours of a figure with a colour map
            picture = picture.convert("RGB").quantize(128, dither=Image.Dither.NONE)
        picture.save(target, optimize=True)


@click.command(help=__doc__.splitlines()[0])
@click.option("--results", type=click.Path(path_type=Path), default=ROOT / "results", show_default=True)
@click.option("--verdicts", is_flag=True, help="Copy the claims and the table of verdicts, too.")
@click.argument("figures", nargs=-1, required=True)
def main(results, verdicts, figures):
    figures = [results / f"figures/{name}.png" for name in figures]
    verdicts = [results / f"tables/claims{suffix}" for suffix in (".csv", ".md")] if verdicts else []
    for file in (*figures, *verdicts):
        if not file.is_file():
            raise click.ClickException(f"no {file}; make it first, then publish all results together")
    for file in figures:
        copy_figure(file, ROOT / "docs/results" / file.name)
    if verdicts:
        table, page = verdicts
        (ROOT / "docs/claims.csv").write_text(split_table(table)[1], encoding="utf-8")
        (ROOT / "docs/verdicts.md").write_text(page.read_text(encoding="utf-8"), encoding="utf-8")
    click.echo(f"copied: {', '.join(file.name for file in (*figures, *verdicts))}")


if __name__ == "__main__":
    main()
