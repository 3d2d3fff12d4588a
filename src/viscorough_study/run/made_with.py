"""Record what the results of a job are made with: rule, settings, inputs, source code, versions of packages.

`run_job` records this once in each job, and every function that writes a result adds the record to its file. A result
thereby states its settings even if it is copied to another folder.
"""

import hashlib
import json
import platform
from importlib.metadata import version

PACKAGES = ("viscorough", "numpy", "scipy", "numba", "ducc0", "xarray", "netCDF4", "pandas", "matplotlib", "snakemake")
# Longer settings, such as the texts of all claims, are recorded by a digest [characters of JSON].
LONGEST = 4000

_RECORD = {}


def record_job(rule, inputs, params):
    """Record the rule, the inputs and the params of the job of this process; see `origin`."""
    _RECORD.update(origin(rule, inputs, params), versions=versions())


def made_with():
    """Return {"made_with": the record of this job} for the file of a result; empty outside a job."""
    return {"made_with": dict(_RECORD)} if _RECORD else {}


def origin(rule, inputs, params):
    """Return what decides the content of a result: rule, paths of its inputs, settings, and digest of the source code.

    params : params of the rule; `source` is the digest of the source code, all others are settings
    """
    settings = {name: _shortened(value) for name, value in params.items() if name != "source"}
    return {"rule": rule, "inputs": list(map(str, inputs)), "settings": settings, "source": params.get("source")}


def versions():
    """Return {name: version} of Python and of the packages that compute, store and draw."""
    return {"Python": platform.python_version()} | {name: version(name) for name in PACKAGES}


def _shortened(value):
    """Return a setting as values of JSON, or the digest of its JSON if that is longer than LONGEST."""
    text = json.dumps(value, default=str)
    return json.loads(text) if len(text) <= LONGEST else f"sha256 {hashlib.sha256(text.encode()).hexdigest()}"
