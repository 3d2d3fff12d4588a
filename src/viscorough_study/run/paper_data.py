"""Read data in resources/ of the project: laws, numbers, claims and sentences of the paper, and published tables."""

import csv
from pathlib import Path

import yaml


def read_paper(folder, name):
    """Return the content of a YAML file in a folder.

    name : "laws", "numbers", "claims" or "sentences", the name of the file without suffix
    """
    return yaml.load((Path(folder) / f"{name}.yaml").read_text(encoding="utf-8"), yaml.CSafeLoader)


def read_records(path):
    """Return the rows of a CSV file as [{column: value}], where a value is a number or text."""
    with Path(path).open(newline="", encoding="utf-8") as file:
        return [{name: yaml.safe_load(value) for name, value in row.items()} for row in csv.DictReader(file)]
