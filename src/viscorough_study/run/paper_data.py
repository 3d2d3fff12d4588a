"""Read data in resources/ of the project: laws and numbers of the paper, and published tables."""

import csv
from pathlib import Path

import yaml


def read_paper(folder, name):
    """Return the content of a YAML file in a folder.

    name : "laws" or "numbers", the name of the file without suffix
    """
    return yaml.load((Path(folder) / f"{name}.yaml").read_text(encoding="utf-8"), yaml.CSafeLoader)


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
