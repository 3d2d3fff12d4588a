"""Make tables of workflow/results.yaml."""

from pkgutil import resolve_name

import pandas as pd

from viscorough.io import netcdf
from viscorough.io.datasets import read_dataset
from viscorough_study.performance import timing
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, recorded, write_table


def read_input(path):
    """Return the table of a CSV file, the dataset of a NetCDF file, or an iterator over Contents of NetCDF files."""
    if not isinstance(path, str):
        return map(netcdf.read, path)
    return read_table(path) if path.endswith(".csv") else read_dataset(path)


def main(files, csv, nc, *, functions, tables, arguments):
    """Make tables from files, {argument of the function: path, or paths}, and its further arguments.

    functions : dotted names of the function that makes the tables ("tabulate"), and of the columns of each table
    tables : {table: its entry, with label, dimension, and whether it is timed, so that the machine is recorded}
    """
    inputs = {name: read_input(path) for name, path in files.items()}
    made = resolve_name(functions["tabulate"])(**inputs, **arguments)
    made = dict.fromkeys(tables, made) if isinstance(made, pd.DataFrame) else made
    timed = any("timed" in entry for entry in tables.values())
    attributes = recorded(settings=arguments, **({"machine": timing.machine()} if timed else {}))
    for (name, entry), *paths in zip(tables.items(), csv, nc, strict=True):
        title = entry["label"][0].upper() + entry["label"][1:]
        description = {"columns": resolve_name(functions[name]), "dimension": entry["dimension"], "title": title}
        write_table(made[name], *paths, **description, attributes=attributes)


run_job(globals(), lambda job: main(dict(job.input), **job.output, **job.params))
