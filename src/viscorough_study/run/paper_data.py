"""Read published tables, which are in resources/ of the project."""

import csv
from pathlib import Path


def read_records(path):
    """Return the rows of a CSV file as [{column: value}], where a value is a number, text or None."""
    with Path(path).open(newline="", encoding="utf-8") as file:
        return [{name: _value(text) for name, text in row.items()} for row in csv.DictReader(file)]


def _value(text):
    """Return the number in a cell, its text if it is no number, or None if it is empty."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text or None
