"""Describe the measured surfaces (scans) that the settings name, as input of the jobs that compute loading curves.

The description of a scan is called a sample.
"""

import hashlib
import re
from glob import glob
from pathlib import Path

from viscorough.io.matrices import is_npy, is_text
from viscorough_study.run.settings_model import ScanGroup


def scans(entries, curves):
    """Return {name of a scan: its description} for all files of measured heights that the setting `measured` names.

    entries : setting `measured`; its patterns of files are relative to the working directory
    curves : section `curves` of the settings

    Like all descriptions of surfaces for jobs (run.samples), the description of a scan has the keys pool, realizations,
    batch, indentation and group. It also has file, bytes (size of the file) and digest (of the content of the file).
    The keys spacing, unit, preparation, forces, young_modulus and poisson_ratio are from the entry of the setting. The
    name of a scan consists of the names of its group and its file.

    Raises ValueError if a pattern matches no file, if two scans have the same name, and if a matrix of numbers, which
    has no place to state them, is given without spacing or unit.
    """
    ends = {"tolerance": curves["measured_tolerance"], "until_x": curves["until_x"]}
    shared = {"pool": "measured", "realizations": 1, "batch": 1, "indentation": ends}
    result = {}
    for entry in entries:
        # Settings that are not given have their default values; steps of the preparation are then left out.
        complete = {"preparation": {}} | ScanGroup(**entry).model_dump(exclude={"preparation"}) | entry
        for pattern in entry["files"]:
            matching = map(Path, glob(pattern, recursive=True, include_hidden=True))
            files = sorted(str(path) for path in matching if path.is_file())
            if braces := [file for file in files if set(file) & set("{}")]:
                raise ValueError(f"measured, {entry['name']}: {braces[0]} has a brace in its name; rename the file")
            if not files:
                raise ValueError(f"measured, {entry['name']}: there is no file {pattern} in {Path.cwd()}")
            for file in files:
                name = f"{entry['name']}_{re.sub('[^A-Za-z0-9]+', '_', Path(file).stem).strip('_')}"
                if name in result and result[name]["file"] != file:
                    both = f"{result[name]['file']} and {file}"
                    raise ValueError(f"measured: {both} have the same name {name}; allowed: different names")
                missing = [key for key in ("spacing", "unit") if not complete[key]]
                if missing and _is_matrix(file):
                    needed = " and ".join(f"measured.{key}" for key in missing)
                    raise ValueError(f"measured, {entry['name']}: {file} is a matrix of numbers; {needed} must be set")
                result[name] = shared | complete | _content(file) | {"group": entry["name"], "file": file}
    return result


def _is_matrix(file):
    """Return True if a file begins as a .npy file or as text."""
    with open(file, "rb") as opened:
        start = opened.read(4096)
    return is_npy(start, file) or is_text(start)


def _content(file):
    """Return the size of a file and a digest of its content.

    The digest is a parameter of the jobs that use the file, so the jobs are rerun only if the content changes.
    """
    with open(file, "rb") as opened:
        digest = hashlib.file_digest(opened, "sha256").hexdigest()[:16]
    return {"digest": digest, "bytes": Path(file).stat().st_size}
