"""Prepare the run before all rules: find the project, check packages and folders, and set the jobs' environment."""

import importlib.util
import os
import sys
from pathlib import Path

import yaml


def path_of(source):
    """Return the path of a source file or folder that Snakemake describes by an object."""
    return Path(str(source.get_path_or_uri(secret_free=False)))


# Folder of this workflow, found from this file: a workflow that uses this workflow as a module is in another folder.
WORKFLOW = path_of(workflow.current_basedir).parent
PROJECT = WORKFLOW.parent


def read_yaml(path):
    """Return the content of a file of the project."""
    return yaml.load((PROJECT / path).read_text(encoding="utf-8"), yaml.CSafeLoader)


def end_run(message, place=""):
    """End Snakemake with a message of one line; a WorkflowError would show three more lines about this file.

    place : words after "Error" that say where the error is
    """
    raise SystemExit(f"{f'Error {place}'.strip()}: {message}")


def use_packages_of_checkout():
    """Make sure that rules and jobs use the packages of this checkout, or end the run with one line.

    Without this check, a Snakemake that is installed in another checkout would use the packages of the other checkout,
    and edits in src/ of this checkout would have no effect. A copy of the workflow without src/ uses installed packages
    of the same version.
    """
    if special := sorted(set(sys.executable) & set(" \t\n'\"\\$`&;|<>()*?[]")):
        end_run(
            f"{sys.executable}: the path of the Python interpreter has {' '.join(map(repr, special))}, and no job can "
            "start, since Snakemake does not quote it; move the folder to a path without"
        )
    source = PROJECT / "src"
    if not (source / "viscorough_study").is_dir():
        from viscorough import __version__

        required = read_yaml("CITATION.cff")["version"]
        if __version__ != required:
            end_run(
                f"{PROJECT}: viscorough {__version__} is installed; version {required} is needed, as in CITATION.cff"
            )
        return
    if importlib.util.find_spec("viscorough_study") is None:  # an installed library comes without the study
        sys.path.insert(0, str(source))
        # Python finds the packages in jobs by this variable.
        os.environ.update(PYTHONPATH=os.pathsep.join(filter(None, [sys.path[0], os.environ.get("PYTHONPATH")])))
    for package in ("viscorough", "viscorough_study"):
        found = Path(importlib.util.find_spec(package).origin).parent
        if not found.samefile(source / package):
            end_run(
                f"this Snakemake uses {package} of {found.parent}, not of this checkout, {source}; run `make environment` "
                f"in {PROJECT}, and then {PROJECT}/.venv/bin/snakemake"
            )


def check_folder():
    """End the run with one line unless Snakemake and its jobs can write into the working directory."""
    for folder in map(Path, (".", ".snakemake", "results")):
        if folder.is_dir() and not os.access(folder, os.W_OK | os.X_OK):
            end_run(
                f"{folder.resolve()}: the folder cannot be written; make it writable, or let "
                "`snakemake --directory FOLDER` write all results to another folder"
            )


use_packages_of_checkout()
check_folder()

# Use one thread per job, since jobs run side by side. Numba reads only its own variable, not OMP_NUM_THREADS.
os.environ.update(NUMBA_NUM_THREADS="1", OMP_NUM_THREADS="1")
# By default, glibc returns the memory of a large array to the system when it is freed, and requests it again page by
# page for the next array.
os.environ.update(MALLOC_MMAP_THRESHOLD_=str(2**25), MALLOC_TRIM_THRESHOLD_=str(10**9))
os.environ.setdefault("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1")  # use large pages of memory, if the system has them

if workflow.is_main_process:  # false in the processes of jobs
    from viscorough_study.run.stale_locks import remove_stale_locks

    remove_stale_locks()
