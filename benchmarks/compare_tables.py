"""Compare the tables, ensembles and loading curves of two finished runs, value by value.

    python benchmarks/compare_tables.py OLD NEW

OLD is a folder of results from before the ensembles of a run were pooled in one file, NEW one from after. Numbers must
agree to 1e-12 relative and texts must be equal. What is not compared as it stands is listed below with its reason, and
printed: files and columns with another name, reworded texts, measured times, and rows that are now derived from others.
The exit code is 1 if a difference has no such reason.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import click
import numpy as np
import pandas as pd
import xarray as xr

from viscorough_study.conventions import in_every_reading
from viscorough_study.pool import ensembles

TOLERANCE = 1e-12  # relative: rounding of another order of operations, far below any tolerance of a computation
MEASURED = "contains times and memory measured on a machine"


@dataclass(frozen=True)
class Changed:
    """How a table of OLD differs from that in NEW.

    name : of its file in NEW; derive : function that gives the table of OLD from that of NEW, with its reason
    reworded : {column whose text is new: reason}; unlike : reason why the table is not compared at all
    """

    name: str = ""
    derive: Callable | None = None
    derive_reason: str = ""
    reworded: dict = field(default_factory=dict)
    unlike: str = ""


READINGS = "rows of the readings of the law are derived from the stored fits (viscorough_study.conventions)"
CASES = "stress-test cases, methods and messages have other names; rows are compared in their order"
CHANGED = {
    "scaling.csv": Changed(derive=in_every_reading, derive_reason=READINGS),
    "sizes.csv": Changed(derive=in_every_reading, derive_reason=READINGS),
    "sizes_trends.csv": Changed(reworded={"finding": "'untold' is 'undetermined'"}),
    "claims.csv": Changed(reworded={"criterion": "criteria are reworded in resources/paper/claims.yaml"}),
    "prices.csv": Changed("rule_costs.csv", unlike=MEASURED),
    "methods.csv": Changed(unlike=MEASURED),
    "peers.csv": Changed("other_solvers.csv", unlike=MEASURED),
    "scenes.csv": Changed("level_placement.csv", unlike=MEASURED),
    "large.csv": Changed(unlike=MEASURED),
    "stability.csv": Changed(
        "failure_map.csv", reworded=dict.fromkeys(("group", "difficulty", "method", "verdict", "reason"), CASES)
    ),
}
VARIABLES = {"operators": "operator_applications"}  # of loading curves, in OLD and in NEW
POOLS = {"discs": ("discs", "size_discs"), "lines": ("lines", "size_lines")}  # of NEW, for each kind of ensemble


class Report:
    """Differences, exceptions and the number of values that were compared."""

    def __init__(self):
        self.values, self.largest, self.differences, self.exceptions = 0, 0.0, [], {}

    def note(self, reason, name):
        """Remember an exception, of which those with the same reason are printed together."""
        self.exceptions.setdefault(reason, []).append(name)

    def compare(self, name, old, new):
        """Compare two arrays of numbers or texts."""
        old, new = np.asarray(old), np.asarray(new)
        if old.shape != new.shape:
            self.differences.append(f"{name}: shape {old.shape} in OLD, {new.shape} in NEW")
            return
        self.values += old.size
        if old.dtype.kind not in "biuf" or new.dtype.kind not in "biuf":
            differ = np.flatnonzero(old.astype(str) != new.astype(str))
            if differ.size:
                texts = old.ravel()[differ[0]], new.ravel()[differ[0]]
                self.differences.append(f"{name}: {differ.size} texts differ, first {texts[0]!r} and {texts[1]!r}")
            return
        deviation = relative_deviation(old.astype(float), new.astype(float))
        worst = deviation.max(initial=0.0)
        self.largest = max(self.largest, worst)
        if worst > TOLERANCE:
            number = np.count_nonzero(deviation > TOLERANCE)
            self.differences.append(f"{name}: {number} of {old.size} numbers differ, by up to {worst:.2g} relative")


def relative_deviation(old, new):
    """|new − old| over the larger of the two; 0 where they are equal or both nan, inf where one is nan or infinite."""
    equal = (old == new) | (np.isnan(old) & np.isnan(new))
    with np.errstate(invalid="ignore", divide="ignore"):
        deviation = np.abs(new - old) / np.maximum(np.abs(old), np.abs(new))
    return np.where(equal, 0.0, np.where(np.isfinite(deviation), deviation, np.inf))


def compare_table(report, path, folder):
    """Compare a table of OLD with that in a folder of NEW."""
    changed = CHANGED.get(path.name, Changed())
    new_path = folder / (changed.name or path.name)
    if changed.name:
        report.note("the file has another name", f"{path.name}: {changed.name}")
    if changed.unlike:
        report.note(f"not compared: it {changed.unlike}", path.name)
        return
    if not new_path.is_file():
        report.differences.append(f"{path.name}: not in NEW")
        return
    old, new = pd.read_csv(path), pd.read_csv(new_path)
    if changed.derive:
        report.note(changed.derive_reason, path.name)
        new = changed.derive(new)
    for column in old:
        if column in changed.reworded:
            report.note(changed.reworded[column], f"{path.name}, column {column}")
        elif column not in new:
            report.differences.append(f"{path.name}: column {column} is not in NEW")
        elif old[column].isna().all() and new[column].isna().all():
            report.compare(f"{path.name}, {column}", [len(old)], [len(new)])
        else:
            report.compare(f"{path.name}, {column}", old[column], new[column])
    if more := sorted(set(new) - set(old)):
        report.note("columns only in NEW", f"{path.name}: {', '.join(more)}")


def compare_ensembles(report, old, new):
    """Compare the ensemble of every case in OLD with that taken out of the pools of NEW."""
    for kind, pools in POOLS.items():
        cases = {}
        for pool in pools:
            if (path := new / f"{pool}.nc").is_file():
                with xr.open_dataset(path) as content:
                    cases |= ensembles(content.load(), "case")
        for path in sorted((old / kind).glob("*.nc")):
            if path.stem not in cases:
                report.differences.append(f"ensemble {kind}/{path.stem}: not in NEW")
                continue
            with xr.open_dataset(path) as ensemble:
                for name in (*ensemble.data_vars, "x", "hurst", "elements", "diameter"):
                    values = cases[path.stem][name].values
                    report.compare(f"ensemble {kind}/{path.stem}, {name}", ensemble[name].values, values)
    report.note("ensembles are taken out of the pools of NEW, with their averages", "ensembles/{discs,lines}")


def compare_curves(report, old, new):
    """Compare the loading curves of every case, whatever the batches."""
    for folder in sorted(path for path in old.glob("*/*") if path.is_dir()):
        name = folder.relative_to(old).as_posix()
        if not list((new / name).glob("*.nc")):
            report.differences.append(f"curves {name}: not in NEW")
            continue
        of_old, of_new = joined_batches(folder), joined_batches(new / name)
        for variable, values in of_old.variables.items():
            report.compare(f"curves {name}, {variable}", values, of_new[VARIABLES.get(variable, variable)])
    for variable, renamed in VARIABLES.items():
        report.note("the variable of loading curves has another name", f"{variable}: {renamed}")


def joined_batches(folder):
    """Dataset of all realizations of a case."""
    batches = []
    for path in sorted(folder.glob("*.nc")):
        with xr.open_dataset(path) as batch:
            batches.append(batch.load())
    return xr.concat(batches, "realization", data_vars="minimal", coords="minimal", compat="equals", join="outer")


@click.command(help=__doc__.splitlines()[0])
@click.argument("old", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.argument("new", type=click.Path(exists=True, file_okay=False, path_type=Path))
def main(old, new):
    report = Report()
    for path in sorted((old / "tables").glob("*.csv")):
        compare_table(report, path, new / "tables")
    compare_ensembles(report, old / "ensembles", new / "ensembles")
    compare_curves(report, old / "curves", new / "curves")
    for reason, names in report.exceptions.items():
        click.echo(f"exception: {reason}\n    " + "\n    ".join(names))
    for difference in report.differences:
        click.echo(f"DIFFERENCE: {difference}")
    count = f"{len(report.differences)} unexplained differences"
    click.echo(f"{report.values} values compared, largest relative deviation {report.largest:.2g}; {count}")
    sys.exit(bool(report.differences))


if __name__ == "__main__":
    main()
