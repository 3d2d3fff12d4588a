"""Copies of the project in which campaigns may run and break things."""

import os
import shutil
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
_NOT_COPIED = shutil.ignore_patterns(".git", ".venv*", ".snakemake", ".pytest_cache", ".hypothesis")


def copy_project(folder):
    """Copy the project into a folder.

    Of the folders called results, only the results of runs are left out.
    """

    def not_copied(parent, names):
        return _NOT_COPIED(parent, names) | ({"results"} if Path(parent) == ROOT else set())

    shutil.copytree(ROOT, folder, ignore=not_copied, dirs_exist_ok=True)


def environment(folder):
    """Return the variables of this process, with the packages of the copy before the installed ones."""
    return os.environ | {"PYTHONPATH": str(folder / "src")}
