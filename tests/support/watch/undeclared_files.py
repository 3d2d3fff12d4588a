"""Find the files that a job reads although its rule does not declare them.

A job may read its inputs, and files whose path or digest is in its params. Snakemake would not run the job again after
a change of any other file.
"""

import hashlib
import os
import sys
from pathlib import Path

# Files of atomic writing and of compiled functions.
_CACHES = (".part", ".nbi", ".nbc")
WRITTEN = "undeclared.txt"  # file in the working directory with a line for each undeclared file of each job


def watch():
    """Return a set that collects the absolute paths of all files that this process opens for reading from now on."""
    opened = set()

    def hook(event, arguments):
        if event == "open" and isinstance(arguments[0], str) and not arguments[2] & os.O_WRONLY:
            opened.add(os.path.abspath(arguments[0]))

    import netCDF4

    dataset = netCDF4.Dataset

    class Watched(dataset):
        """The NetCDF library opens its files without an event of Python."""

        def __init__(self, path, *arguments, **options):
            opened.add(os.path.abspath(path))
            super().__init__(path, *arguments, **options)

    sys.addaudithook(hook)
    netCDF4.Dataset = Watched
    return opened


def write_undeclared(job, opened):
    """Append the undeclared files of a job, which Snakemake describes to its script, to the file `WRITTEN`."""
    if job is None:
        return
    params = str(dict(job.params.items()))
    declared = {os.path.abspath(path) for path in (*job.input, *job.output, *job.log)}
    libraries = [sys.prefix, sys.base_prefix, "/proc", "/sys", "/dev", "/etc", "/usr", os.path.abspath(".snakemake")]
    # Snakemake puts the working directory, with all results, into sys.path.
    libraries += [folder for folder in map(os.path.abspath, sys.path) if folder != os.getcwd()]
    with open(WRITTEN, "a", encoding="utf-8") as file:
        for path in sorted(opened - declared):
            if (
                path.endswith(_CACHES)
                or "fontlist" in path
                or not os.path.isfile(path)
                or path == os.path.abspath(WRITTEN)
            ):
                continue
            if any(path.startswith(f"{folder}/") for folder in libraries):
                continue
            digest = hashlib.sha256(Path(path).read_bytes()).hexdigest()[:16]
            if os.path.relpath(path) not in params and digest not in params:
                file.write(f"{job.rule}: {path}\n")
