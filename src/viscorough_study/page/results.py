"""Read tables of results for the page, and keep numbers together with their place in a table.

Every number that the page states in a sentence is a `Number`. Its place in a table, the rule that made the table and
the source file of the computation become part of the page, and a reader or a test can look them up.
"""

from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from viscorough_study.run.tables import read_recorded, read_table
from viscorough_study.verdicts.claims import JUDGES

MAY_BE_EMPTY = ("convention", "reason", "setting")  # columns of texts, which may be empty
# Options of pandas.read_csv, by which only empty fields are nan.
_ONLY_EMPTY_IS_MISSING = {"keep_default_na": False, "na_values": [""]}


@dataclass(frozen=True)
class Number:
    """A number on the page, and its place in a table of results/tables.

    value : the number; table : name of the table; column : name of the column
    row : row of the CSV file, counted from 0 without the header; None if the number is a count of rows
    counted : if the number is a count of rows, the value in the column that these rows have
    origin : rule that made the table and source file of the computation, as text
    """

    value: float
    table: str
    column: str
    row: int | None = None
    counted: str | None = None
    origin: str = ""

    @property
    def attributes(self):
        """Return attributes of the HTML element that holds the number: its value, a tooltip, and its place.

        The tooltip states the line of the CSV file, counted from 1, with the header as line 1.
        """
        if self.counted is None:
            place = f"line {self.row + 2}, column {self.column}"
        else:
            place = f"{self.column}: number of {self.counted}"
        title = "; ".join(filter(None, (f"results/tables/{self.table}.csv, {place}", self.origin)))
        named = {"value": repr(self.value), "title": title}
        named |= {f"data-{name}": getattr(self, name) for name in ("table", "row", "column", "counted")}
        return {name: value for name, value in named.items() if value is not None}


@dataclass(frozen=True)
class Results:
    """The tables of a run, with their recorded settings and their origins.

    tables : {name: pandas.DataFrame}, indexed by the row of the CSV file
    settings : {name of a table: mapping}; the mapping is empty if no settings were recorded
    origins : {name of a table: (rule, source file)} from `table_origins`; numbers of other tables state no origin
    """

    tables: dict
    settings: dict
    origins: dict = field(default_factory=dict)

    def rows(self, table, **chosen):
        """Return the rows of a table that have the values in `chosen`, {column: value}."""
        rows = self.tables[table]
        return rows[(rows[list(chosen)] == list(chosen.values())).all(axis=1)]

    def number(self, table, row, column):
        """Return the Number in a row and a column of a table."""
        value = float(self.tables[table].at[row, column])
        return Number(value, table, column, int(row), origin=self.origin(table, row))

    def record(self, table, row):
        """Return one row of a table as a record, {column: Number, or text}."""
        values = self.tables[table].loc[row].items()
        return {name: value if isinstance(value, str) else self.number(table, row, name) for name, value in values}

    def records(self, table, **chosen):
        """Return the records of the rows that have the values in `chosen`, {column: value}."""
        return [self.record(table, row) for row in self.rows(table, **chosen).index]

    def extremes(self, rows, table, column):
        """Return the smallest and the largest Number in a column; (None, None) if the column has no number.

        rows : rows of the table that are searched
        """
        ends = rows[column].dropna().agg(["idxmin", "idxmax"]) if rows[column].notna().any() else ()
        return tuple(self.number(table, row, column) for row in ends) or (None, None)

    def count(self, table, column, counted):
        """Return the number of rows with the value `counted` in a column, as a Number."""
        number = int((self.tables[table][column] == counted).sum())
        return Number(number, table, column, counted=counted, origin=self.origin(table))

    def origin(self, table, row=None):
        """Return the rule that made a table and the source file of the computation as text, empty if unknown.

        For a row of the table `claims`, the source file is the module with the criterion of this claim.
        """
        if table not in self.origins:
            return ""
        rule, source = self.origins[table]
        if table == "claims" and row is not None:
            source = _source_file(JUDGES[self.tables[table].at[row, "claim"]].__module__)
        return f"rule {rule}; computed in {source}"


def table_origins(registry):
    """Return {table: (rule that makes the table, source file of the computation)}.

    The source file contains the function of the rule, or is the script of a rule that has no function.
    registry : section `tables` of workflow/results.yaml
    """
    origins = {}
    for rule, made in registry.items():
        module = made["function"].rpartition(".")[0] if "function" in made else None
        source = _source_file(module) if module else f"workflow/scripts/{rule}.py"
        origins |= dict.fromkeys(made["tables"], (rule, source))
    return origins


def _source_file(module):
    """Return the path of a module's source file, relative to the folder of the project."""
    return f"src/{module.replace('.', '/')}.py"


def read_results(tables, origins):
    """Read the Results of a run: tables from CSV files, and their settings from NetCDF files.

    tables : {name: path of the CSV file}; the NetCDF file has the same path, except for the suffix .nc
    origins : {name of a table: (rule, source file)} from `table_origins`
    """
    files = {name: Path(path).with_suffix(".nc") for name, path in tables.items()}
    settings = {name: read_recorded(file, "settings", missing={}) for name, file in files.items()}
    read = {name: read_table(path, **_ONLY_EMPTY_IS_MISSING) for name, path in tables.items()}
    return Results({name: _with_empty_texts(table) for name, table in read.items()}, settings, origins)


def read_published(path):
    """Read a CSV file of published results; empty fields are "" in columns of texts, and nan in other columns."""
    return _with_empty_texts(pd.read_csv(path, **_ONLY_EMPTY_IS_MISSING))


def _with_empty_texts(table):
    return table.assign(**{name: table[name].astype(object).fillna("") for name in MAY_BE_EMPTY if name in table})
