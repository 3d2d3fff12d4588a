"""Copy figures, tables and verdicts from results into the project: docs/ and the data of the packages.

    python benchmarks/publish.py --results results --command reproduce

Every command (`make paper`, `make speed`, ...) has its own figures and tables, which are copied into docs/results/ with
their origin. Name the commands whose results are in the folder: some of the files also exist at a smaller scale.
`reproduce` includes the verdicts, docs/claims.csv and the page docs/verdicts.md, and the cost of the default run.
`paper` includes the calibrated power law, `law` the law of the interface, and `law-errors` its errors.
"""

import io
import json
import shutil
import subprocess
from datetime import UTC, datetime
from pathlib import Path

import click
import pandas as pd
from measuring import write_json
from PIL import Image  # matplotlib depends on it

from viscorough_study.performance import timing
from viscorough_study.run.tables import read_table, split_table

ROOT = Path(__file__).resolve().parents[1]
OTHER_SOLVERS, DEFAULT_COSTS = "resources/published/other_solvers.csv", "resources/published/default_costs.csv"


def _made(figures="", tables="", others=""):
    """Return files in results/ with these names of figures, names of tables, and other files."""
    figures, tables = (names.split() for names in (figures, tables))
    return [*(f"figures/{name}.png" for name in figures), *(f"tables/{name}.csv" for name in tables), *others.split()]


# {command of make: files that it makes in results/ and that docs/results/ publishes}
PUBLISHED = {
    "reproduce": _made(
        "fig1_surfaces fig2_kinetics fig3_master_curve fig4_exponent regions validation mdr_lambda",
        "scaling zeta_laws local_slope validation direct rule_costs mdr_lambda mdr_summary mdr_exponents",
    ),
    "beyond": _made("interface reduction media histories", "interface periodic literature"),
    "paper": _made(tables="sensitivities"),
    "speed": _made(
        "speed",
        "methods other_solvers one_surface mean_accuracy sufficient_models",
    ),
    "stability": _made("failures", "failures", "campaign.json"),
    "fine-grids": _made("local_exponent"),
    "large": _made(tables="large"),
    "bench": ["benchmarks.json"],
    "law": _made(tables="law"),
    "law-errors": _made(tables="law_errors"),
}
# {command: {file in results/ that other parts of the project read: its place there}}
KEPT = {
    "paper": {
        "tables/reduction.csv": "resources/published/reduction.csv",
        "tables/calibration.csv": "src/viscorough/law/data/calibration.csv",
    },
    "fine-grids": {"tables/fine_exponents.csv": "resources/published/fine_exponents.csv"},
    "speed": {"tables/second_solver.csv": "resources/published/second_solver.csv"},
    "law": {"tables/law.csv": "src/viscorough/law/data/law.csv"},
    "reproduce": {
        "tables/rule_costs.csv": DEFAULT_COSTS,
        "tables/claims.csv": "docs/claims.csv",
        "tables/claims.md": "docs/verdicts.md",
    },
}


def copy_other_solvers(table, target, machine, date):
    """Write the times of other solvers on one thread over the time of the path, with date and machine.

    Solutions that do not meet the residual have no time.
    """
    times = read_table(table).query("solver != 'viscorough' and threads == 1").dropna(subset="ratio")
    times = times[["task", "hurst", "elements", "levels", "solver", "version", "threads", "ratio"]]
    times = times.assign(ratio=times["ratio"].map("{:.3g}".format), measured=date, machine=machine)
    times.to_csv(target, index=False, lineterminator="\n")


def date_of(file):
    """Return the day on which a file was made."""
    return datetime.fromtimestamp(file.stat().st_mtime, UTC).date().isoformat()


def copy_picture(file, target):
    """Copy a PNG file: git keeps every version, so figures without a colour map get at most 128 colours."""
    with Image.open(file) as picture:
        if picture.mode == "P":  # save_figure keeps all colours of a figure with a colour map
            picture = picture.convert("RGB").quantize(128, dither=Image.Dither.NONE)
        picture.save(target, optimize=True)


def plain_table(file):
    """Return the CSV text of a table without its first line, which tables of some benchmarks do not have."""
    text = file.read_text(encoding="utf-8")
    return split_table(file)[1] if text.startswith("# {") else text


def copy_table(file, target):
    """Copy a table with eight significant digits, which needs half of the bytes: git keeps every version."""
    text = pd.read_csv(io.StringIO(plain_table(file)), keep_default_na=False, na_values=[""])
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
            (project / target).write_text(plain_table(results / name), encoding="utf-8")
            if target == DEFAULT_COSTS:
                costs = read_table(results / name).assign(measured=date_of(results / name), machine=where)
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
@click.option("--command", "commands", type=click.Choice(list(PUBLISHED)), multiple=True, default=["reproduce"])
def main(results, commands):
    describe = ["git", "describe", "--always", "--dirty", "--exclude=*"]
    commit = subprocess.run(describe, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
    copy_results(results, ROOT, commands, commit)
    click.echo(f"copied: results of {', '.join(commands)}")


if __name__ == "__main__":
    main()
