"""Read tables that the command line writes."""

import re

import pandas as pd


def read_table(path):
    """Return (columns by names without units, {name: unit}) of a table; columns without a unit have the unit 1."""
    table = pd.read_csv(path, comment="#")
    units = {name: unit or "1" for name, unit in (re.fullmatch(r"(\w+)(?: \((.*)\))?", t).groups() for t in table)}
    return table.set_axis([*units], axis=1), units
