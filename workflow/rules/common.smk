"""Functions and constants of the rules; code independent of Snakemake is in viscorough_study."""

import csv
import hashlib
import importlib.util
import os
import re
import subprocess
import sys
import time
from functools import cache
from pathlib import Path

import yaml
from snakemake.io import apply_wildcards, get_wildcard_names
from snakemake.utils import update_config


def path_of(source):
    """Path of a file or folder as Snakemake knows it."""
    return Path(str(source.get_path_or_uri(secret_free=False)))


# The folder of this file; a workflow that uses it as a module is in another folder.
WORKFLOW = path_of(workflow.current_basedir).parent
PROJECT = WORKFLOW.parent


def read_yaml(path):
    return yaml.load((PROJECT / path).read_text(encoding="utf-8"), yaml.CSafeLoader)


def read_records(path):
    """Rows of a CSV file as [{column: number or text}]."""
    with (PROJECT / path).open(newline="", encoding="utf-8") as file:
        rows = csv.DictReader(file)
        return [{name: yaml.safe_load(value) for name, value in row.items()} for row in rows]


def end_run(message):
    """End Snakemake with one line; a WorkflowError would show three more lines, about this file."""
    raise SystemExit(f"Error: {message}")


def use_packages_of_checkout():
    """Make sure that rules and jobs use the packages of this checkout, or end with one line.

    Without this check, the Snakemake of another checkout would run the packages of that one: edits in src/ of this
    checkout would have no effect. A copy of the workflow without src/ uses installed packages of the same version.
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
        # Jobs find the packages by this variable.
        os.environ.update(PYTHONPATH=os.pathsep.join(filter(None, [sys.path[0], os.environ.get("PYTHONPATH")])))
    for package in ("viscorough", "viscorough_study"):
        found = Path(importlib.util.find_spec(package).origin).parent
        if not found.samefile(source / package):
            end_run(
                f"this Snakemake uses {package} of {found.parent}, not of this checkout, {source}; run `make environment` "
                f"in {PROJECT}, and then {PROJECT}/.venv/bin/snakemake"
            )


def check_folder():
    """End with one line unless Snakemake and its jobs can write into the folder of the run."""
    for folder in map(Path, (".", ".snakemake", "results")):
        if folder.is_dir() and not os.access(folder, os.W_OK | os.X_OK):
            end_run(
                f"{folder.resolve()}: the folder cannot be written; make it writable, or let "
                "`snakemake --directory FOLDER` write all results to another folder"
            )


use_packages_of_checkout()
check_folder()

from viscorough.io.atomic import atomic_write, path_named
from viscorough_study.run import cases
from viscorough_study.run.paper_data import read_paper
from viscorough_study.run.scans import scans
from viscorough_study.run.settings import check_settings, source_of
from viscorough_study.run.settings_files import read_settings_file
from viscorough_study.run.source_digest import SourceDigests
from viscorough_study.run.stale_locks import remove_stale_locks

# One thread per job, since jobs run side by side. Numba reads only its own variable.
os.environ.update(NUMBA_NUM_THREADS="1", OMP_NUM_THREADS="1")
# By default, glibc returns the memory of a large array to the system when it is freed, and requests it again page by
# page for the next array.
os.environ.update(MALLOC_MMAP_THRESHOLD_=str(2**25), MALLOC_TRIM_THRESHOLD_=str(10**9))
os.environ.setdefault("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1")  # large pages, if the system has them

# Threads of a timed job, so that no other job runs with it: Snakemake reduces them to --cores. `workflow.cores` would
# make --unlock, --summary, --rulegraph and --report fail without --cores.
ALL_CORES = 10**6

if workflow.is_main_process:  # not one of its jobs
    remove_stale_locks()


SOURCES = SourceDigests(Path(importlib.util.find_spec("viscorough").origin).parents[1], ".snakemake/sources.json")


def complete(settings, files, options):
    """The default settings with these in their place, and the cases of the measured surfaces that they name.

    settings : all that are given by files, by the command line, or by a workflow that uses this one as a module
    files : of settings, which must be readable; options : settings given by --config
    Ends with one line about the first file that cannot be read or is missing, or the first wrong setting and its file.
    """
    defaults = PROJECT / "config" / "config.yaml"
    try:
        completed = read_settings_file(defaults)
        update_config(completed, settings)
        sources = {shown(defaults): read_settings_file(defaults), "the settings of the module": settings}
        sources |= {shown(path): read_settings_file(path) for path in files} | {"--config": options}
        check_settings(completed, read_yaml("workflow/schemas/config.schema.yaml"), sources)
        with path_named(source_of(["measured"], sources)):
            return completed, scans(completed["measured"], completed["indentation"])
    except ValueError as error:
        # A WorkflowError would show three more lines, about this file.
        raise SystemExit(f"Error in the settings: {error}")


def shown(path):
    """A path from the folder of the run, if it is in there."""
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path)


# ---- inputs and params


def chosen(section, *names):
    """{name: setting} of these settings of a section."""
    return {name: config[section][name] for name in names}


def without(section, *names):
    """{name: setting} of a section without these settings."""
    return {name: value for name, value in config[section].items() if name not in names}


def batch_ensembles(table, case, batch):
    """Ensembles of a batch of a case; ends with one line if the settings do not have this batch."""
    if batch not in (existing := cases.batches(table[case])):
        end_run(f"batch {batch} of {case} is not one of the settings; allowed: {', '.join(existing)}")
    return cases.batch_ensembles(table[case], batch)


def scan_value(name):
    """Input or params function: a value of the measured surface."""
    return lambda wildcards: MEASURED[wildcards.scan][name]


def kind_of_pool(pool):
    return pool if pool == "measured" else "lines" if pool.endswith("lines") else "discs"


def batches_of_pool(pool):
    """[(case, batch)] of a pool."""
    return cases.pool_batches(CASES[kind_of_pool(pool)], pool)


def curves_of_pool(pool):
    return [f"results/curves/{kind_of_pool(pool)}/{case}/{batch}.nc" for case, batch in batches_of_pool(pool)]


def curves_of_combinations():
    """Curves of the discs of all combinations."""
    bases = [name for name, case in DISCS.items() if case["group"] == "base"]
    return [f"results/curves/discs/{case}/{batch}.nc" for case in bases for batch in cases.batches(DISCS[case])]


def groups_of_pool(wildcards):
    """Group of each batch of a pool."""
    return [CASES[kind_of_pool(wildcards.pool)][case]["group"] for case, _ in batches_of_pool(wildcards.pool)]


@cache
def paper(name):
    """Content of a file in resources/paper."""
    return read_paper(PROJECT / "resources" / "paper", name)


def text_digests(paths):
    """Digests of texts that are not results of the run; their paths depend on the location of the project."""
    return [hashlib.sha256(path.read_bytes()).hexdigest()[:16] for path in paths]


# ---- report

# Categories of the report, which sorts them by name.
CHAPTERS = {
    "summary": "1 Summary",
    "figures": "2 Figures of the paper",
    "verdicts": "3 Verdicts",
    "choices": "4 Conventions and validation",
    "fits": "5 Fits",
    "speed": "6 Speed and accuracy",
    "failures": "7 Where methods fail",
    "beyond": "8 Beyond the paper",
}


RESULTS = read_yaml("workflow/results.yaml")
FIGURES = {
    name: {"target": "all", "params": [], "file": name, "module": name} | entry
    for name, entry in RESULTS["figures"].items()
}
TABULATION_DEFAULTS = {"target": "all", "input": {}, "memory": 1000, "queued": False, "alone": False}
TABULATIONS = {name: TABULATION_DEFAULTS | entry for name, entry in RESULTS["tables"].items()}


def table_files(target):
    """Files of the tables that a target makes, without those of the costs, which are made last."""
    tabulations = [made for made in TABULATIONS.values() if made["target"] == target]
    names = [name for made in tabulations for name in made["tables"] if name != "rule_costs"]
    return expand("results/tables/{table}.{kind}", table=names, kind=("csv", "nc"))


def table_functions(tabulation):
    """The function that makes the tables of a rule, and the columns of each table, as in scripts/tabulate.py."""
    default = tabulation["function"].rpartition(".")[0] + ".COLUMNS"
    columns = {name: table.get("columns", default) for name, table in tabulation["tables"].items()}
    return {"tabulate": tabulation["function"]} | columns


def figure_files(target):
    """Files of the figures of a target, by their rules."""
    return [getattr(rules, f"plot_{name}").output for name, figure in FIGURES.items() if figure["target"] == target]


def figure_functions(figure):
    """The function that draws a figure and those that read inputs other than tables, as in scripts/plot.py."""
    readers = [argument for argument, path in figure["input"].items() if not path.endswith(".csv")]
    draw = {"draw": "viscorough_study.figures.{module}.plot_{module}".format(**figure)}
    return draw | {argument: f"viscorough_study.figures.inputs.{argument}" for argument in readers}


def chapter(name):
    """Category of a result, as a function, which Snakemake calls only when it makes a report."""

    def category(wildcards):
        require_current()
        return CHAPTERS[name]

    return category


def require_current():
    """End with one line if jobs would have to run before the report, whose captions would not match the results."""
    if outdated := sorted({job.rule.name for job in workflow.dag.needrun_jobs() if job.output}):
        raise SystemExit(
            "Error: results were not made with these settings and sources; run the workflow first, or give the settings "
            f"that they were made with. Outdated or missing: {', '.join(outdated[:5])}{', ...' * (len(outdated) > 5)}"
        )


# ---- memory of a job [MB]


def indentation_memory(wildcards):
    case = CASES[wildcards.kind][wildcards.case]
    return cases.measured_memory(case) if wildcards.kind == "measured" else cases.disc_memory(case)


def pool_memory(wildcards):
    return cases.pool_memory(CASES[kind_of_pool(wildcards.pool)], wildcards.pool, config["ensemble"])


# ---- all rules

KERNELS_BENCHMARK = "results/benchmarks/compile_kernels.tsv"  # of `compile_kernels`, which is no rule


def own_rules():
    """The rules of this workflow, without those of one that uses it as a module."""
    return [member for member in workflow.rules if path_of(member.basedir).is_relative_to(WORKFLOW)]


def benchmark_files(counted):
    """{rule: benchmark files of its jobs} of rules, with the jobs of these settings."""
    names = {"discs": ["case"], "lines": ["line"], "measured": ["case", "scan"]}  # wildcards for a case, by kind
    kinds = {pool: kind_of_pool(pool) for pool in cases.POOLS}
    jobs = [
        dict.fromkeys(names[kind], case) | {"batch": batch, "kind": kind, "pool": pool}
        for pool, kind in kinds.items()
        for case, batch in batches_of_pool(pool)
    ]
    files = {}
    for member in counted:
        if pattern := member.benchmark:
            described = [job for job in jobs if get_wildcard_names(pattern) <= job.keys()]
            files[member.name] = sorted({apply_wildcards(pattern, job) for job in described})
    return files


def complete_rules(rules):
    """Give the rules what all have in common, which they do not state.

    Every rule without a docstring gets its message, for `snakemake --list`; every rule with a script, an environment, a
    log and a benchmark for each job, and an unnamed parameter, the digest of the source code that it uses. Snakemake
    itself sees changes of a script, but not of its imports, and would rerun for reworded comments: profiles/default
    switches its trigger `code` off.
    """
    for member in rules:
        member.docstring = member.docstring or re.sub(r"{wildcards\.(\w+)}", r"{\1}", member.message or "")
        if member.script:
            member.conda_env = "../envs/viscorough.yaml"
            wildcards = [f"{{{name}}}" for name in re.findall(r"{([a-z]+)", member.output[0])]
            job = "/".join([member.name, *wildcards])
            member.log_modifier = member.benchmark_modifier = member.output_modifier
            member.set_log(f"results/logs/{job}.log")
            member.benchmark = f"results/benchmarks/{job}.tsv"
            functions = dict(member.params).get("functions", {})  # imported by name in the script
            member.set_params(SOURCES.digest(WORKFLOW / "rules" / member.script, *functions.values()))


def compile_kernels():
    """Compile the solvers once before any job.

    This is no rule: an output that many jobs need would rerun them all when it is remade, and as an `ancient` input it
    hides changes of their parameters from Snakemake.
    """
    stamp = Path(".snakemake") / "kernels"
    digest = SOURCES.digest(Path(importlib.util.find_spec("viscorough_study.run.kernels").origin))
    if stamp.is_file() and stamp.read_text() == digest:
        return
    print("Compiling the solvers, once: about 20 seconds", file=sys.stderr, flush=True)
    start = time.monotonic()
    subprocess.run([sys.executable, "-m", "viscorough_study.run.kernels"], check=True)
    cost = Path(KERNELS_BENCHMARK)  # as for a job, without its memory
    cost.parent.mkdir(parents=True, exist_ok=True)
    with atomic_write(cost) as temporary:
        temporary.write_text(f"s\tmax_rss\n{time.monotonic() - start:.2f}\t\n")
    stamp.write_text(digest)
