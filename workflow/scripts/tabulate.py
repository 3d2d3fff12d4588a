"""Make the tables that workflow/results.yaml lists for one rule."""

from pkgutil import resolve_name

import pandas as pd

from viscorough.io import netcdf
from viscorough.io.datasets import read_dataset
from viscorough_study.performance import timing
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, recorded, write_table


def read_input(path):
    """Read a CSV file as a table, a NetCDF file as a dataset, or a list of NetCDF files as an iterator of Contents."""
    if not isinstance(path, str):
        return map(netcdf.read, path)
    return read_table(path) if path.endswith(".csv") else read_dataset(path)


def main(files, csv, nc, *, functions, tables, arguments):
    """Call one function that makes tables, and write the tables.

    files : {argument of the function: path or list of paths of its data}; arguments : its further arguments
    functions : {"tabulate": dotted name of the function, name of a table: dotted name of its columns}
    tables : {name of a table: its entry in workflow/results.yaml}; if an entry is `timed`, the machine is recorded
    csv, nc : lists of the CSV and NetCDF files to write, one for each table
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
