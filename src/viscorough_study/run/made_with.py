"""Record in every result what it is made with: rule, inputs, settings, source code, versions of packages.

`run_job` makes this record once in each job, and each function that writes a result adds it to the file: an attribute
of NetCDF files, the first line of tables and texts, a text of figures, the last line of the page. A result thereby
states its settings even if it is copied to another folder, or if Snakemake has lost its own records.
"""

import contextlib
import hashlib
import json
import platform
import re
from importlib.metadata import version
from pathlib import Path

NAME = "made_with"  # name of the record in a file
PACKAGES = ("viscorough", "numpy", "scipy", "numba", "ducc0", "xarray", "netCDF4", "pandas", "matplotlib", "snakemake")
# Longer settings, such as the ensembles of a large batch, are recorded by a digest [characters of JSON].
LONGEST = 4000

_RECORD = {}


# ---- the record of a job


def record_job(rule, inputs, params):
    """Record the job of this process: `origin`, and the versions with which it and all jobs before it have run."""
    used = {name: [number] for name, number in versions().items()}
    _RECORD.update(origin(rule, inputs, params), versions=all_versions([{"versions": used}, *map(read_record, inputs)]))


def made_with():
    """Return {NAME: record of this job} for a file; empty outside a job."""
    return {NAME: dict(_RECORD)} if _RECORD else {}


def made_with_text():
    """Return {NAME: record of this job as JSON} for a file that stores texts; empty outside a job."""
    return {name: json.dumps(record) for name, record in made_with().items()}


def origin(rule, inputs, params):
    """Return what decides the content of a result: rule, paths of its inputs, settings, and digest of the source code.

    params : params of the rule; `source` is the digest of the source code, all others are settings
    """
    settings = {name: _shortened(value) for name, value in params.items() if name != "source"}
    paths = _shortened(list(map(str, inputs)))
    return {"rule": rule, "inputs": paths, "settings": settings, "source": _shortened(params.get("source"))}


def versions():
    """Return {name: version} of Python and of the packages that compute, store and draw."""
    return {"Python": platform.python_version()} | {name: version(name) for name in PACKAGES}


def all_versions(records):
    """Return {name: list of all versions} in records; a list with several versions shows an upgrade between jobs."""
    found = {}
    for record in records:
        for name, numbers in (record or {}).get("versions", {}).items():
            found[name] = sorted({*found.get(name, []), *numbers})
    return found


def _shortened(value):
    """Return a setting as values of JSON, or the digest of its JSON if that is longer than LONGEST."""
    text = json.dumps(value, default=str, sort_keys=True)
    return json.loads(text) if len(text) <= LONGEST else f"sha256 {hashlib.sha256(text.encode()).hexdigest()}"


# ---- records in files


def read_record(path):
    """Return the record in the file of a result; None if there is none, or if it cannot be read."""
    reader = _READERS.get(Path(path).suffix)
    with contextlib.suppress(OSError, ValueError, KeyError, AttributeError, TypeError):
        return reader(path)
    return None


def difference(path, expected):
    """Return (recorded, expected) texts of the first part in which a record differs from `origin`; None if none does.

    path : file of a result; expected : `origin` of the job that would make it
    """
    record = read_record(path)
    if record is None:
        return "no record", "a record"
    before, now = _flat(record), _flat(expected)
    for name in (*before, *(now.keys() - before.keys())):
        texts = [json.dumps(parts.get(name), sort_keys=True) for parts in (before, now)]
        if len({*texts}) > 1:
            return tuple(f"{name} {text}" for text in texts)
    return None


def _flat(record):
    return {name: record.get(name) for name in ("rule", "source", "inputs")} | record.get("settings", {})


def _in_netcdf(path):
    from viscorough.io.netcdf import opened  # this import takes long, and many jobs read only tables

    with opened(path, checked=False) as file:
        return json.loads(file.getncattr(NAME))


def _in_first_line(path):
    with open(path, encoding="utf-8") as file:
        return json.loads(file.readline().removeprefix("# "))[NAME]


def _in_last_line(path):
    return json.loads(Path(path).read_text(encoding="utf-8").splitlines()[-1].removeprefix(f"<!-- {NAME} ")[:-4])


def _in_png(path):
    content, name = Path(path).read_bytes(), f"tEXt{NAME}\0".encode()
    start = content.index(name)
    length = int.from_bytes(content[start - 4 : start])
    return json.loads(content[start + len(name) : start + 4 + length])


def _in_pdf(path):
    text = re.search(rb"/Subject \(((?:\\.|[^\\()])*)\)", Path(path).read_bytes())[1]
    return json.loads(re.sub(rb"\\(.)", rb"\1", text))


_READERS = {
    ".nc": _in_netcdf,
    ".csv": _in_first_line,
    ".txt": _in_first_line,
    ".html": _in_last_line,
    ".png": _in_png,
    ".pdf": _in_pdf,
}


def text_line():
    """Return the first line of a text that states the record of this job; empty outside a job."""
    return f"# {json.dumps(made_with())}\n" if _RECORD else ""


def html_line():
    """Return the last line of a page that states the record of this job; empty outside a job."""
    return f"\n<!-- {NAME} {json.dumps(_RECORD).replace('--', '-' + chr(92) + 'u002d')} -->\n" if _RECORD else ""
