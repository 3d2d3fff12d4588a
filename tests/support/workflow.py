"""Copies of the project, Snakemake runs in them, and their plans."""

import fcntl
import importlib.util
import multiprocessing
import os
import re
import runpy
import shutil
import subprocess
import sys
import tempfile
import threading
from multiprocessing.connection import wait
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
TEST = ("--configfile", "config/test.yaml")
RESULTS = yaml.safe_load((ROOT / "workflow/results.yaml").read_text(encoding="utf-8"))
TABLES = {name: table | rule for rule in RESULTS["tables"].values() for name, table in rule["tables"].items()}
FIGURES = {figure.get("file", name): figure for name, figure in RESULTS["figures"].items()}  # by their files
HANGS = 3000  # seconds after which a run is taken to hang: ten times the longest on a busy machine
TARGETS = {"all", "article", "curves", "figures", "tables", "validation", "speed", "stability", "sizes"}
TARGETS |= {"costs", "measured", *(f"figure_{number}" for number in range(1, 5))}


def copy_project(folder):
    """A copy of the workflow, so that tests can run, edit and break it; it uses the packages of this project."""
    for name in ("workflow", "config", "profiles", "resources"):
        shutil.copytree(ROOT / name, folder / name)
    shutil.copytree(ROOT / "docs/results", folder / "docs/results")
    for name in ("Snakefile", "CITATION.cff", "docs/claims.csv", "docs/rules.png"):  # the last ones for the page
        shutil.copy(ROOT / name, folder / name)
    return folder


def copy_kernels(finished, folder):
    """Let a project in which nothing has run yet know, from a finished one, that the solvers are compiled."""
    (folder / ".snakemake").mkdir()
    shutil.copy(finished / ".snakemake/kernels", folder / ".snakemake")


def copy_sources(folder):
    """Add a copy of the packages, so that tests can edit them."""
    shutil.copytree(ROOT / "src", folder / "src", ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))


def made_once(tmp_path_factory, name, make):
    """A folder that the first test that needs it makes, in any process of the test session; tests must not change it.

    make : function of the new, empty folder
    """
    common = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        common = common.parent
    folder, made = common / name, common / f"{name}.made"
    with open(common / f"{name}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # one process at a time
        if not made.exists():
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            make(folder)
            made.touch()
    return folder


def environment(folder, project=None):
    """The variables of this process, with the packages of a project before the installed ones.

    project : by default the copy, if it has packages, otherwise this project
    Python may keep compiled sources: otherwise every job of a copy would compile them again.
    """
    project = project or (folder if (folder / "src").is_dir() else ROOT)
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return kept | {"PYTHONPATH": str(project / "src")}


# Every run is a copy of a process that has loaded Snakemake and what the packages of this project import. So are its
# jobs, most of which take less time than these imports, but for the first one of each script: it shows that the script
# works in a new process.
COPIES = multiprocessing.get_context("forkserver")
PRELOADED = ["snakemake.cli", "snakemake.workflow", "snakemake.report.html_reporter", "smart_open", "nbformat"]
PRELOADED += ["jsonschema", "netCDF4", "numba", "pandas", "xarray", "scipy.special", "scipy.optimize"]
PRELOADED += ["matplotlib.backends.backend_agg", "matplotlib.backends.backend_pdf", "support.workflow"]
COPIES.set_forkserver_preload(PRELOADED)


def _enter(variables, folder, output):
    """Take over the variables, the folder and the output of a process that was asked for this copy."""
    os.environ.clear()
    os.environ.update(variables)
    sys.path[:0] = os.environ["PYTHONPATH"].split(os.pathsep)
    os.chdir(folder)
    with open(output, "a") as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)


def _run_snakemake(arguments, variables, folder, output):
    _enter(variables, folder, output)
    sys.argv = ["snakemake", *arguments]
    python = importlib.import_module("snakemake.script").PythonScript
    in_new_process, scripts = python.execute_script, set()
    # Snakemake runs each job in a thread. A process can be asked only once for its exit code, and starting one asks all
    # that have ended: a thread that joined its own at that moment would be told 255.
    one_thread = threading.Lock()

    def execute_script(self, path, edit=False):
        if (script := self.path.get_filename()) not in scripts:
            scripts.add(script)
            in_new_process(self, path, edit)
            return
        job = COPIES.Process(target=_run_job, args=(path, dict(os.environ), os.getcwd(), output))
        with one_thread:
            job.start()
        with importlib.import_module("snakemake.benchmark").benchmarked(job.pid, self.bench_record):
            wait([job.sentinel])
        with one_thread:
            job.join()
        if job.exitcode:
            raise subprocess.CalledProcessError(job.exitcode, path)

    python.execute_script = execute_script
    importlib.import_module("snakemake.cli").main(arguments)


def _run_job(path, *surroundings):
    _enter(*surroundings)
    try:
        runpy.run_path(path, run_name="__main__")
    except BaseException:
        sys.excepthook(*sys.exc_info())
        sys.exit(1)


def snakemake(folder, *arguments, fails=False, cores=2, project=None):
    """Run Snakemake in a copy of the project; stdout and stderr together.

    cores : None leaves --cores out; project : of `environment`
    """
    number = () if cores is None else ("--cores", cores)
    with tempfile.NamedTemporaryFile("r") as output:
        line = ["--nocolor", *map(str, (*number, *arguments))]
        run = COPIES.Process(target=_run_snakemake, args=(line, environment(folder, project), folder, output.name))
        run.start()
        run.join(HANGS)
        text = output.read()
    assert run.exitcode is not None, text
    assert (run.exitcode != 0) == fails, text
    return text


def jobs(text):
    """{rule: number of jobs} of a dry run's output, without the target rules."""
    table = re.search(r"Job stats:\n.*\n-.*\n(?P<rows>(?:\w+ +\d+\n)+)", text)
    if table is None:
        assert "Nothing to be done" in text
        return {}
    numbers = {name: int(number) for name, number in re.findall(r"(\w+) +(\d+)\n", table["rows"])}
    return {name: number for name, number in numbers.items() if name not in {"total", *TARGETS}}


def plan(folder, *arguments):
    """{rule: number of jobs} that a run would have."""
    return jobs(snakemake(folder, "--dry-run", *arguments))


def settings_file(folder, name, **settings):
    path = folder / f"{name}.yaml"
    path.write_text(yaml.safe_dump(settings))
    return path


def load_script(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / f"workflow/scripts/{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def merged(base, extra):
    """Settings overridden by those of a --configfile: mappings are merged, everything else is replaced."""
    if not (isinstance(base, dict) and isinstance(extra, dict)):
        return extra
    return base | {key: merged(base.get(key), value) for key, value in extra.items()}


def read_settings(name):
    return yaml.safe_load((ROOT / "config" / f"{name}.yaml").read_text())
