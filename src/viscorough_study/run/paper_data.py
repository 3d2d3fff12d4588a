"""Read laws, numbers, claims and sentences of the paper, which are data in resources/paper of the project."""

from pathlib import Path

import yaml


def read_paper(folder, name):
    """Return the content of one of the files `laws`, `numbers`, `claims` and `sentences` in the folder."""
    return yaml.load((Path(folder) / f"{name}.yaml").read_text(encoding="utf-8"), yaml.CSafeLoader)
