"""Read tables of results for the page, and keep numbers together with their place in a table.

Every number that the page states in a sentence is a `Number`. The page contains, for each Number, its place in a table,
and the Snakemake rule that made the table. A reader or a test can look these up.
"""

from dataclasses import dataclass

from viscorough_study.run.tables import read_table, split_table

MAY_BE_EMPTY = ("reading", "note", "reason", "setting")  # columns of texts; some of these texts may be empty
# With these options, pandas.read_csv replaces only empty fields by nan, and keeps texts such as "none".
_ONLY_EMPTY_IS_MISSING = {"keep_default_na": False, "na_values": [""]}


@dataclass(frozen=True)
class Number:
    """A number on the page, and its place in a table of results/tables.

    A Number is either the value in one cell of the table, or the number of rows that have a certain value in a column.

    value : the number
    table, column : names of the table and of the column
    row : row of the cell, counted from 0 without the header; None for a number of rows
    counted : for a number of rows, the value that these rows have in the column; otherwise None
    origin : text that names the Snakemake rule that made the table
    """

    value: float
    table: str
    column: str
    row: int | None = None
    counted: str | None = None
    origin: str = ""

    @property
    def attributes(self):
        """Return attributes of the HTML element that holds the number: value, tooltip, and place in the table.

        The tooltip states the line of the CSV file, counted from 1; the names of the columns are in line 2.
        """
        if self.counted is None:
            place = f"line {self.row + 3}, column {self.column}"
        else:
            place = f"{self.column}: number of {self.counted}"
        title = "; ".join(filter(None, (f"results/tables/{self.table}.csv, {place}", self.origin)))
        named = {"value": repr(self.value), "title": title}
        named |= {f"data-{name}": getattr(self, name) for name in ("table", "row", "column", "counted")}
        return {name: value for name, value in named.items() if value is not None}


@dataclass(frozen=True)
class Results:
    """The tables of a run, with the records of the jobs that made them.

    tables : {name: pandas.DataFrame}, indexed by the row of the CSV file
    made_with : {name of a table: record of its job (run.made_with)}
    """

    tables: dict
    made_with: dict

    def rows(self, table, **chosen):
        """Return the rows of a table that have, in each column named in `chosen`, the given value."""
        rows = self.tables[table]
        return rows[(rows[list(chosen)] == list(chosen.values())).all(axis=1)]

    def number(self, table, row, column):
        """Return the Number in a row and a column of a table."""
        value = float(self.tables[table].at[row, column])
        return Number(value, table, column, int(row), origin=self.origin(table))

    def record(self, table, row):
        """Return one row of a table as a dict, {column: Number or text}."""
        values = self.tables[table].loc[row].items()
        return {name: value if isinstance(value, str) else self.number(table, row, name) for name, value in values}

    def records(self, table, **chosen):
        """Return the rows that have the given value in each column named in `chosen`, as dicts (see `record`)."""
        return [self.record(table, row) for row in self.rows(table, **chosen).index]

    def extremes(self, rows, table, column):
        """Return the smallest and the largest Number in a column; (None, None) if the column has no number.

        rows : the rows of the table to be searched
        """
        ends = rows[column].dropna().agg(["idxmin", "idxmax"]) if rows[column].notna().any() else ()
        return tuple(self.number(table, row, column) for row in ends) or (None, None)

    def count(self, table, column, counted):
        """Count the rows with the value `counted` in a column, and return this count as a Number."""
        number = int((self.tables[table][column] == counted).sum())
        return Number(number, table, column, counted=counted, origin=self.origin(table))

    def origin(self, table):
        """Return a text that names the rule that made a table."""
        return f"rule {self.made_with[table]['rule']}"


def read_results(tables):
    """Read the Results of a run; tables : {name: path of the CSV file}"""
    made_with = {name: split_table(path)[0]["made_with"] for name, path in tables.items()}
    read = {name: read_table(path, **_ONLY_EMPTY_IS_MISSING) for name, path in tables.items()}
    return Results({name: _with_empty_texts(table) for name, table in read.items()}, made_with)


def _with_empty_texts(table):
    return table.assign(**{name: table[name].astype(object).fillna("") for name in MAY_BE_EMPTY if name in table})
