"""Prepare the run, and define functions and constants for the rules.

The first part finds the project, checks packages and folders, and sets the environment of the jobs. It comes before the
imports of this project's packages. Code that does not depend on Snakemake is in viscorough_study.

A comment gives the reason for each name of Snakemake that its documentation does not contain. All these names exist
since Snakemake 9.0.0 at the latest.
"""

import hashlib
import importlib.util
import os
import sys
from pathlib import Path

import yaml
from snakemake import persistence

# Folder of this workflow, found from this file: a workflow that uses this workflow as a module is in another folder.
# Not documented: `current_basedir`. `workflow.source_path`, which is documented, returns the path of a copy of the file.
WORKFLOW = Path(workflow.current_basedir).parent
PROJECT = WORKFLOW.parent
# A timed job requests this number of threads, which Snakemake reduces to the number of --cores, so that no other job
# runs at the same time. `workflow.cores` would make --unlock, --summary, --rulegraph and --report fail without --cores.
ALL_CORES = 10**6


# ---- before the imports of this project's packages


def end_run(message, place=""):
    """End Snakemake with a message of one line; a WorkflowError would show three more lines about this file.

    place : words after "Error" that say where the error is
    """
    raise SystemExit(f"{f'Error {place}'.strip()}: {message}")


def read_yaml(path):
    """Return the content of a file of the project."""
    return yaml.load((PROJECT / path).read_text(encoding="utf-8"), yaml.CSafeLoader)


def use_packages_of_checkout():
    """Make sure that rules and jobs use the packages of this checkout, or end the run with one line.

    Without this check, a Snakemake that is installed in another checkout would use the packages of the other checkout,
    and edits in src/ of this checkout would have no effect. A copy of the workflow without src/ uses installed packages
    of the same version.
    """
    if special := sorted(set(sys.executable) & set(" \t\n'\"\\$`&;|<>()*?[]")):
        end_run(
            f"{sys.executable}: the path of the Python interpreter has {' '.join(map(repr, special))}, and no job can "
            "start, since Snakemake does not quote it; move the folder to a path without such characters"
        )
    source = PROJECT / "src"
    if importlib.util.find_spec("viscorough") is None:
        raise ModuleNotFoundError(name="viscorough")
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


check_folder()

# Use one thread per job, since jobs run side by side. Numba reads only its own variable, not OMP_NUM_THREADS.
os.environ.update(NUMBA_NUM_THREADS="1", OMP_NUM_THREADS="1")
# By default, glibc returns the memory of a large array to the system when it is freed, and requests it again page by
# page for the next array.
os.environ.update(MALLOC_MMAP_THRESHOLD_=str(2**25), MALLOC_TRIM_THRESHOLD_=str(10**9))
os.environ.setdefault("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1")  # use large pages of memory, if the system has them

try:
    use_packages_of_checkout()
    from viscorough_study.fits.fine_sentence import judged_rows
    from viscorough_study.run import samples
    from viscorough_study.run.kernels import compile_once
    from viscorough_study.run.made_with import difference, origin
    from viscorough_study.run.names import SHOWN
    from viscorough_study.run.paper_data import read_records
    from viscorough_study.run.scans import scans
    from viscorough_study.run.settings import changed_settings, check_settings, complete_settings, path_shown
    from viscorough_study.run.source_digest import SourceDigests
    from viscorough_study.run.stale_locks import remove_stale_locks
except ModuleNotFoundError as error:  # also raised if a package has no metadata
    end_run(
        f"the package {error.name} is not installed for {sys.executable}; run `make environment` in {PROJECT}, and then "
        f"{PROJECT}/.venv/bin/snakemake"
    )

# Not documented: `is_main_process`, which is false in the processes of jobs. On another machine of a cluster, such a
# process could take the lock of its own run for a stale one.
if workflow.is_main_process:
    try:
        remove_stale_locks(unlock="--unlock" in sys.argv)
    except ValueError as error:
        end_run(error)

SOURCES = SourceDigests(Path(importlib.util.find_spec("viscorough").origin).parents[1], ".snakemake/sources.json")


# ---- records


def compare_with_records():
    """Let Snakemake make a result again if the record in its file differs from the job that would make it.

    Snakemake's own records, in .snakemake, are lost if results are copied without this folder; Snakemake would then keep
    results of other settings. They also say nothing about files that were replaced later.
    """
    # Not documented: the class that compares a job with Snakemake's records, and its methods.
    known = getattr(persistence, "PersistenceBase", None) or persistence.Persistence
    has_metadata, params_changed = known.has_metadata, known.params_changed

    def is_own(job):
        return Path(job.rule.basedir).is_relative_to(WORKFLOW)

    def changed(self, job, file=None):
        changes = params_changed(self, job, file)
        expected = origin(job.rule.name, job.input, dict(job.params.items()))
        for path in (job.output if file is None else [file]) if is_own(job) else ():
            if Path(path).suffix != ".md" and os.path.exists(path) and (texts := difference(path, expected)):
                before, now = ({text} for text in texts)
                changes = changes | persistence.ParamsChange(only_old=before, only_new=now, files={path})
        return changes

    known.has_metadata = lambda self, job: is_own(job) or has_metadata(self, job)
    known.params_changed = changed


if workflow.is_main_process:
    compare_with_records()


# ---- settings


def with_scans(settings):
    """Check settings; return them in the form in which the workflow uses them, and the samples of scans."""
    settings = check_settings(settings)
    return settings, scans(settings["measured"], settings["curves"])


def complete(given, files):
    """Complete and check the settings; return them and the samples of scans. End the run if a setting is wrong."""
    try:
        return complete_settings(PROJECT / "config" / "config.yaml", given, files, with_scans)
    except ValueError as error:
        end_run(f"{error}", "in the settings")


def chosen(section, *names):
    """Return {name: setting} of the named settings of a section."""
    return {name: config[section][name] for name in names}


def without(section, *names):
    """Return {name: setting} of all settings of a section except the named settings."""
    return {name: value for name, value in config[section].items() if name not in names}


# ---- source code and other data of the project, for params


def digest(script):
    """Return a digest of the source code that a job uses, so that a change of this code reruns the job.

    The param `source` of every rule with a script is this digest. It replaces Snakemake's trigger `code`, which
    profiles/default switches off: that trigger does not see changes of the modules that a script imports, and it reruns
    a job when only comments have changed.

    script : name of the script in workflow/scripts
    """
    return SOURCES.digest(WORKFLOW / "scripts" / f"{script}.py")


def text_digests(paths):
    """Return digests of text files, for params; as inputs, the files would have paths that depend on the folder."""
    return [hashlib.sha256(path.read_bytes()).hexdigest()[:16] for path in paths]


NUMBERS = read_yaml("resources/paper/numbers.yaml")  # numbers that the paper states


# ---- inputs, params and memory of jobs, by sample and by pool


def batch_ensembles(table, sample, batch):
    """Return the ensembles in a batch of a sample, see `samples.batch_ensembles`; end the run if there is no such batch."""
    if batch not in (existing := samples.batches(table[sample])):
        end_run(f"batch {batch} of {sample} is not one of the settings; allowed: {', '.join(existing)}")
    return samples.batch_ensembles(table[sample], batch)


def fine_curves():
    """Return the files of the curves of discs on several grids; end the run if the settings name no such discs."""
    if not NESTED:
        end_run("fine_grids.ensembles is empty; give --configfile config/fine_grids.yaml, or run `make fine-grids`")
    return samples.nested_files(NESTED)


def scan_value(name):
    """Return a function of the wildcards, for input or params, that returns a value from the sample of a scan."""
    return lambda wildcards: MEASURED[wildcards.scan][name]


def surfaces_origin(wildcards):
    """Return the params that decide the surfaces of a batch, for the record of their curves.

    The files of surfaces are temporary, so no other file states these params.
    """
    if wildcards.kind == "measured":
        made_from = {name: MEASURED[wildcards.sample][name] for name in ("spacing", "unit", "preparation", "digest")}
        return made_from | {"source": digest("prepare_measured")}
    ensembles = batch_ensembles(DISCS, wildcards.sample, wildcards.batch)
    return {"ensembles": ensembles, "seed": config["seed"], "source": digest("generate_discs")}


def indentation_memory(wildcards, attempt):
    """Return the memory [MB] of a job that indents the surfaces of a batch; more if a try had too little."""
    sample = SAMPLES[wildcards.kind][wildcards.sample]
    memory = samples.measured_memory(sample) if wildcards.kind == "measured" else samples.disc_memory(sample)
    return attempt * memory
