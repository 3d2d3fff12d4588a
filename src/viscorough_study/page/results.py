"""Tables of results for the page, and numbers with their place in a table.

Every number that the page states in a sentence is a `Number`; its place in a table becomes part of the
page, so that a reader or a test can look it up.
"""

from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from viscorough_study.run.tables import read_recorded, read_table

MAY_BE_EMPTY = ("convention", "reason")  # columns of texts
_ONLY_EMPTY_IS_MISSING = {"keep_default_na": False, "na_values": [""]}  # options of pandas.read_csv


@dataclass(frozen=True)
class Number:
    """A number of the page and its place in a table of results/tables: column, and row of the CSV counted from 0.

    counted : of a number of rows, the value that is counted in the column; then there is no row
    """

    value: float
    table: str
    column: str
    row: int | None = None
    counted: str | None = None

    @property
    def attributes(self):
        """Attributes of the HTML element that holds the number: its value, a tooltip, and its place."""
        place = f"row {self.row}, {self.column}"
        place = place if self.counted is None else f"{self.column}: number of {self.counted}"
        named = {"value": repr(self.value), "title": f"results/tables/{self.table}.csv, {place}"}
        named |= {f"data-{name}": getattr(self, name) for name in ("table", "row", "column", "counted")}
        return {name: value for name, value in named.items() if value is not None}


@dataclass(frozen=True)
class Results:
    """Tables by name, as pandas.DataFrames indexed by the row of the CSV, and their recorded settings.

    settings : {table: mapping}, empty for tables that record none
    """

    tables: dict
    settings: dict

    def rows(self, table, **wanted):
        """Rows of a table with these values, {column: value}."""
        rows = self.tables[table]
        return rows[(rows[list(wanted)] == list(wanted.values())).all(axis=1)]

    def number(self, table, row, column):
        """The number at a place of a table."""
        return Number(float(self.tables[table].at[row, column]), table, column, int(row))

    def record(self, table, row):
        """{column: Number, or text} of one row."""
        values = self.tables[table].loc[row].items()
        return {name: value if isinstance(value, str) else self.number(table, row, name) for name, value in values}

    def records(self, table, **wanted):
        """The records of the rows with these values, {column: value}."""
        return [self.record(table, row) for row in self.rows(table, **wanted).index]

    def extremes(self, rows, table, column):
        """The smallest and the largest number in a column of some rows of a table; (None, None) if there is none."""
        ends = rows[column].dropna().agg(["idxmin", "idxmax"]) if rows[column].notna().any() else ()
        return tuple(self.number(table, row, column) for row in ends) or (None, None)

    def count(self, table, column, counted):
        """Number of rows with the value `counted` in a column."""
        return Number(int((self.tables[table][column] == counted).sum()), table, column, counted=counted)


def read_results(tables):
    """Results of the tables at {name: path of the CSV}; the NetCDF files have the same names in the same folder."""
    files = {name: Path(path).with_suffix(".nc") for name, path in tables.items()}
    settings = {name: read_recorded(file, "settings", missing={}) for name, file in files.items()}
    read = {name: read_table(path, **_ONLY_EMPTY_IS_MISSING) for name, path in tables.items()}
    return Results({name: _with_empty_texts(table) for name, table in read.items()}, settings)


def read_published(path):
    """Read a CSV file that the project keeps; empty texts, which pandas reads as nan, become ""."""
    return _with_empty_texts(pd.read_csv(path, **_ONLY_EMPTY_IS_MISSING))


def _with_empty_texts(table):
    return table.assign(**{name: table[name].astype(object).fillna("") for name in MAY_BE_EMPTY if name in table})
