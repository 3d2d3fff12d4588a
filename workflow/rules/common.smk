"""Define functions and constants for the rules; code that does not depend on Snakemake is in viscorough_study."""

import hashlib
import re
from functools import cache

from snakemake.io import apply_wildcards, get_wildcard_names

from viscorough.io.atomic import path_named
from viscorough_study.run import cases
from viscorough_study.run.kernels import KERNELS_BENCHMARK, compile_once
from viscorough_study.run.paper_data import read_paper, read_records
from viscorough_study.run.registry import Registry
from viscorough_study.run.scans import scans
from viscorough_study.run.settings import complete_settings, source_of
from viscorough_study.run.source_digest import SourceDigests

# A timed job requests this number of threads, which Snakemake reduces to the number of --cores, so that no other job
# runs at the same time. `workflow.cores` would make --unlock, --summary, --rulegraph and --report fail without --cores.
ALL_CORES = 10**6

REGISTRY = Registry(read_yaml("workflow/results.yaml"))
SOURCES = SourceDigests(Path(importlib.util.find_spec("viscorough").origin).parents[1], ".snakemake/sources.json")


# ---- settings


def complete(given, files, options):
    """Complete and check the settings; return them and the cases of scans. End the run if a setting is wrong."""
    try:
        defaults = PROJECT / "config" / "config.yaml"
        completed, sources = complete_settings(defaults, given, files, options)
        with path_named(source_of(["measured"], sources)):
            return completed, scans(completed["measured"], completed["indentation"])
    except ValueError as error:
        end_run(f"{error}", "in the settings")


def chosen(section, *names):
    """Return {name: setting} of the named settings of a section."""
    return {name: config[section][name] for name in names}


def without(section, *names):
    """Return {name: setting} of all settings of a section except the named settings."""
    return {name: value for name, value in config[section].items() if name not in names}


# ---- other data of the project


@cache
def paper(name):
    """Return the content of a file in resources/paper; name : name of the file without suffix."""
    return read_paper(PROJECT / "resources" / "paper", name)


def text_digests(paths):
    """Return digests of text files, for params; as inputs, the files would have paths that depend on the folder."""
    return [hashlib.sha256(path.read_bytes()).hexdigest()[:16] for path in paths]


# ---- inputs, params and memory of jobs, by case and by pool


def batch_ensembles(table, case, batch):
    """Return the ensembles in a batch of a case, see `cases.batch_ensembles`; end the run if there is no such batch."""
    if batch not in (existing := cases.batches(table[case])):
        end_run(f"batch {batch} of {case} is not one of the settings; allowed: {', '.join(existing)}")
    return cases.batch_ensembles(table[case], batch)


def scan_value(name):
    """Return a function of the wildcards, for input or params, that returns a value from the case of a scan."""
    return lambda wildcards: MEASURED[wildcards.scan][name]


def indentation_memory(wildcards):
    """Return the memory [MB] of a job that indents the surfaces of a batch."""
    case = CASES[wildcards.kind][wildcards.case]
    return cases.measured_memory(case) if wildcards.kind == "measured" else cases.disc_memory(case)


# ---- report


def chapter(name):
    """Return a function that returns the category of a result. Only a report calls it; it requires current results."""

    def category(wildcards):
        require_current()
        return REGISTRY.chapters[name]

    return category


def require_current():
    """End the run with one line if any result is outdated, since the captions of the report would not match it."""
    if outdated := sorted({job.rule.name for job in workflow.dag.needrun_jobs() if job.output}):
        end_run(
            "results were not made with these settings and sources; run the workflow first, or give the settings that "
            f"they were made with. Outdated or missing: {', '.join(outdated[:5])}{', ...' * (len(outdated) > 5)}"
        )


def figure_files(target):
    """Return the files of all figures that belong to a target, from the rules that draw them."""
    names = (name for name, figure in REGISTRY.figures.items() if figure["target"] == target)
    return [getattr(rules, f"plot_{name}").output for name in names]


def table_files(target):
    """Return the files of all tables that belong to a target."""
    return expand("results/tables/{table}.{kind}", table=REGISTRY.tables(target), kind=("csv", "nc"))


# ---- all rules


def own_rules():
    """Return the rules of this workflow; another workflow that uses it as a module may have further rules."""
    return [member for member in workflow.rules if path_of(member.basedir).is_relative_to(WORKFLOW)]


def benchmark_files(counted):
    """Return {rule: benchmark files of its jobs} of the rules `counted`, for the jobs that the settings need."""
    jobs, files = cases.pool_jobs(CASES), {}
    for member in counted:
        if pattern := member.benchmark:
            described = [job for job in jobs if get_wildcard_names(pattern) <= job.keys()]
            files[member.name] = sorted({apply_wildcards(pattern, job) for job in described})
    return files


def add_digests(rules):
    """Give every rule with a script an unnamed parameter, the digest of the source code that the script uses.

    The digest replaces Snakemake's trigger `code`, which profiles/default switches off. That trigger sees changes of a
    script but not of the modules that it imports, and it reruns a job when only comments have changed.

    Every rule without a docstring gets its message as docstring, which --list shows.
    """
    for member in rules:
        member.docstring = member.docstring or re.sub(r"{wildcards\.(\w+)}", r"{\1}", member.message or "")
        if member.script:
            functions = dict(member.params).get("functions", {})  # functions that the script imports by name
            member.set_params(SOURCES.digest(WORKFLOW / "rules" / member.script, *functions.values()))
