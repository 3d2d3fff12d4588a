"""Write and read tidy tables: CSV files whose first line, "# {JSON}", says what the table is and how it was made.

The JSON object of the first line has the title, the meaning and unit of every column, further attributes, the record of
the job (run.made_with), and the SHA-256 digest of all of this and of the rows. A table that was cut short or changed
after it was written is therefore refused when it is read.
"""

import io
import json
from hashlib import sha256
from pathlib import Path

import pandas as pd

from viscorough.io.atomic import atomic_write
from viscorough.io.refusals import reading
from viscorough_study.run.made_with import made_with

DIGEST = "sha256"  # name of the digest in the first line


def write_table(table, path, *, columns, title, **attributes):
    """Write a tidy table (a pandas.DataFrame) to a CSV file, atomically.

    columns : {column: (long_name, units)} for exactly the columns of the table; text has no units
    title, attributes : further content of the first line; values of JSON

    Each row is one observation. Floats have as many digits as needed to read them back exactly; missing values are
    empty. Raises ValueError if `columns` and the columns of the table differ.
    """
    if differing := sorted(set(columns) ^ set(table.columns)):
        raise ValueError(f"{path}: table and descriptions differ in {', '.join(differing)}; both are needed")
    described = {name: {"long_name": long_name, "units": units} for name, (long_name, units) in columns.items()}
    header = {"title": title, "columns": described, **attributes, **made_with()}
    csv = table.to_csv(index=False, lineterminator="\n")
    line = json.dumps(header | {DIGEST: _digest(header, csv)}, ensure_ascii=False)
    with atomic_write(path) as temporary:
        temporary.write_text(f"# {line}\n{csv}", encoding="utf-8", newline="")


def write_tables(tables, paths, described):
    """Write several tables with `write_table`.

    tables : {name: table}
    paths : paths of the files, in the order of `described`
    described : {name: {"columns": ..., "title": ...}}, arguments of `write_table`
    """
    for (name, description), path in zip(described.items(), paths, strict=True):
        write_table(tables[name], path, **description)


def split_table(path):
    """Return the content of the first line of a table that write_table wrote, as a dict, and the CSV text below it.

    Raises a one-line ValueError, which names the file, if it is missing or damaged.
    """
    with reading(path, "remove the file, so that the next run makes it again"):
        line, _, csv = Path(path).read_bytes().decode().partition("\n")
        if not line.startswith("# {"):
            raise ValueError("its first line, which says how it was made, is missing")
        header = json.loads(line[2:])
        if header.pop(DIGEST, None) != _digest(header, csv):
            raise ValueError("its rows do not match its first line")
    return header, csv


def read_table(path, **options):
    """Return the table in a file that write_table wrote, read with options of pandas.read_csv.

    Raises a one-line ValueError, which names the file, if it is missing or damaged.
    """
    return pd.read_csv(io.StringIO(split_table(path)[1]), **options)


def _digest(header, csv):
    """Return the digest of the first line and of the rows of a table, as 64 hexadecimal digits."""
    return sha256(f"{json.dumps(header)}\n{csv}".encode()).hexdigest()
