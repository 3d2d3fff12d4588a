"""Copy the project, run Snakemake in the copies, and read its plans."""

import copy
import fcntl
import importlib.util
import multiprocessing.forkserver
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
from snakemake.utils import update_config

ROOT = Path(__file__).resolve().parents[2]
TEST = ("--configfile", "config/test.yaml")
RULE_FILES = [ROOT / "Snakefile", *sorted((ROOT / "workflow/rules").glob("*.smk"))]


def read_rules():
    """Return {name of a rule: the text of its definition}."""
    text = "\n".join(path.read_text(encoding="utf-8") for path in RULE_FILES)
    _, *parts = re.split(r"^(?:rule|use rule \w+ as) (\w+)(?: with)?:$", text, flags=re.MULTILINE)
    return dict(zip(parts[::2], parts[1::2], strict=True))


def made_files(pattern):
    """Return {name of a file: rule that makes it}; pattern : regular expression with a group for the name"""
    outputs = {name: re.search(r"    output:\n(?:        .*\n)+", text) for name, text in RULES.items()}
    return {file: rule for rule, output in outputs.items() if output for file in re.findall(pattern, output[0])}


RULES = read_rules()
TABLES = made_files(r"results/tables/(\w+)\.csv")  # {table: its rule}
FIGURES = made_files(r"results/figures/(\w+)\.{format}")  # {file: its rule}
HANGS = 3000  # seconds after which a run counts as hanging: ten times the longest run on a busy machine
WATCH = Path(__file__).resolve().parent / "watch"  # modules that find undeclared files of jobs
TARGETS = {name for name, text in RULES.items() if "    output:\n" not in text and "    script:\n" not in text}


def copy_project(folder):
    """Copy the workflow, so that tests can run, edit and break it. The copy uses the packages of this project."""
    for name in ("workflow", "config", "profiles", "resources"):
        shutil.copytree(ROOT / name, folder / name)
    shutil.copytree(ROOT / "docs/results", folder / "docs/results")
    for name in ("Snakefile", "CITATION.cff", "docs/rules.png"):  # the page shows the last one
        shutil.copy(ROOT / name, folder / name)
    return folder


def copy_kernels(finished, folder):
    """Copy the record that the solvers are compiled from a finished project to a new one."""
    (folder / ".snakemake").mkdir()
    shutil.copy(finished / ".snakemake/kernels", folder / ".snakemake")


def copy_sources(folder):
    """Add a copy of the packages, so that tests can edit them."""
    shutil.copytree(ROOT / "src", folder / "src", ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))


def common_folder(tmp_path_factory):
    """Return the temporary folder of all processes of the test session."""
    own = tmp_path_factory.getbasetemp()
    return own.parent if "PYTEST_XDIST_WORKER" in os.environ else own


def made_once(tmp_path_factory, name, make):
    """Return a folder that the first test that needs it makes, in any process of the session; tests must not change it.

    make : function of the new, empty folder
    """
    common = common_folder(tmp_path_factory)
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
    """Return the variables of this process, with the packages of a project before the installed ones.

    project : by default the copy, if it has packages, otherwise this project

    Python may keep compiled sources: otherwise every job of a copy would compile them again.
    """
    project = project or (folder if (folder / "src").is_dir() else ROOT)
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return kept | {"PYTHONPATH": os.pathsep.join([str(project / "src"), str(WATCH)])}


# Every run is a fork of a process that has already loaded Snakemake and the imports of this project's packages. Jobs
# are forks, too, since most of them take less time than these imports. Only the first job of each script in the test
# session, and of the figures only the first figure, runs in a new process, which shows that the script works there.
COPIES = multiprocessing.get_context("forkserver")
PRELOADED = ["snakemake.cli", "snakemake.workflow", "snakemake.report.html_reporter", "smart_open", "nbformat"]
PRELOADED += ["netCDF4", "numba", "pandas", "pydantic", "xarray", "scipy.special", "scipy.optimize"]
PRELOADED += ["matplotlib.backends.backend_agg", "matplotlib.backends.backend_pdf", "support.workflow"]
COPIES.set_forkserver_preload(PRELOADED)


def _enter(variables, folder, output):
    """Take over the variables, the folder and the output of the process that requested this fork."""
    os.environ.clear()
    os.environ.update(variables)
    sys.path[:0] = os.environ["PYTHONPATH"].split(os.pathsep)
    os.chdir(folder)
    with open(output, "a") as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)


# Variable that names a folder with an empty file for each script that has run in a new process; tests/workflow sets it.
STARTED = "VISCOROUGH_TESTS_STARTED"


def _server_of_forks():
    """Return where other processes reach the server of forks: fields of multiprocessing that it has no names for."""
    multiprocessing.forkserver.ensure_running()
    fields = vars(multiprocessing.forkserver._forkserver)
    return {name: value for name, value in fields.items() if name in ("_forkserver_address", "_forkserver_authkey")}


def _run_snakemake(arguments, variables, folder, output, server):
    _enter(variables, folder, output)
    # Fork the jobs from the same server: otherwise each run would start another server and load all packages again.
    vars(multiprocessing.forkserver._forkserver).update(server, ensure_running=lambda: None)
    sys.argv = ["snakemake", *arguments]
    python = importlib.import_module("snakemake.script").PythonScript
    in_new_process = python.execute_script
    # Snakemake runs each job in a thread. The exit code of a process can be read only once, and starting a process
    # reads the exit codes of all ended ones. Without the lock, a thread that joins its process at that moment would get
    # 255.
    one_thread = threading.Lock()

    def execute_script(self, path, edit=False):
        script = Path(self.path.get_filename()).name
        try:  # the first of several processes makes the file
            Path(os.environ[STARTED], re.sub("plot_.*", "plot", script)).touch(exist_ok=False)
        except FileExistsError:
            execute_in_fork(self, path)
        else:
            in_new_process(self, path, edit)

    def execute_in_fork(self, path):
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
    watching = importlib.import_module("undeclared_files")
    opened = watching.watch()
    try:
        names = runpy.run_path(path, run_name="__main__")
        watching.write_undeclared(names["snakemake"], opened)
    except BaseException:
        sys.excepthook(*sys.exc_info())
        sys.exit(1)


def snakemake(folder, *arguments, fails=False, cores=2, project=None):
    """Run Snakemake in a copy of the project, and return stdout and stderr together.

    cores : None leaves --cores out; project : as in `environment`
    """
    number = () if cores is None else ("--cores", cores)
    with tempfile.NamedTemporaryFile("r") as output:
        line = ["--nocolor", *map(str, (*number, *arguments))]
        surroundings = (environment(folder, project), folder, output.name, _server_of_forks())
        run = COPIES.Process(target=_run_snakemake, args=(line, *surroundings))
        run.start()
        run.join(HANGS)
        text = output.read()
    assert run.exitcode is not None, text
    assert (run.exitcode != 0) == fails, text
    return text


def jobs(text):
    """Return {rule: number of jobs} of a dry run's output, without the target rules."""
    table = re.search(r"Job stats:\n.*\n-.*\n(?P<rows>(?:\w+ +\d+\n)+)", text)
    if table is None:
        assert "Nothing to be done" in text
        return {}
    numbers = {name: int(number) for name, number in re.findall(r"(\w+) +(\d+)\n", table["rows"])}
    return {name: number for name, number in numbers.items() if name not in {"total", *TARGETS}}


def plan(folder, *arguments):
    """Return {rule: number of jobs} that a run would have."""
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
    """Return settings overridden by a --configfile: mappings are merged, everything else is replaced."""
    settings = copy.deepcopy(base)
    update_config(settings, extra)
    return settings


def read_settings(name):
    return yaml.safe_load((ROOT / "config" / f"{name}.yaml").read_text())
