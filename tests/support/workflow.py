"""Copies of the project, Snakemake runs in them, and their plans."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
TEST = ("--configfile", "config/test.yaml")


def copy_project(folder):
    """A copy of everything that the workflow reads, so that tests can run, edit and break it."""
    for name in ("workflow", "config", "profiles", "resources", "src"):
        shutil.copytree(ROOT / name, folder / name)  # with numba's caches beside the modules
    shutil.copy(ROOT / "Snakefile", folder)
    return folder


def command(*arguments):
    return [sys.executable, "-m", "snakemake", "--cores", "2", "--nocolor", *map(str, arguments)]


def environment(folder):
    return os.environ | {"PYTHONPATH": str(folder / "src")}  # before the installed package


def snakemake(folder, *arguments, fails=False):
    """Run Snakemake in a copy of the project; stdout and stderr together."""
    done = subprocess.run(
        command(*arguments),
        cwd=folder,
        env=environment(folder),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=300,
    )
    assert (done.returncode != 0) == fails, done.stdout
    return done.stdout


def jobs(text):
    """{rule: number of jobs} of a dry run's output, without the target rules."""
    table = re.search(r"Job stats:\n.*\n-.*\n(?P<rows>(?:\w+ +\d+\n)+)", text)
    if table is None:
        assert "Nothing to be done" in text
        return {}
    numbers = {name: int(number) for name, number in re.findall(r"(\w+) +(\d+)\n", table["rows"])}
    targets = {"total", "all", "figures", "tables", "validation", "speed", "stability", "sizes", "large", "prices"} | {
        f"figure_{number}" for number in range(1, 5)
    }
    return {name: number for name, number in numbers.items() if name not in targets}


def plan(folder, *arguments):
    return jobs(snakemake(folder, "--dry-run", *arguments))


def settings_file(folder, name, **settings):
    path = folder / f"{name}.yaml"
    path.write_text(yaml.safe_dump(settings))
    return path


def load_script(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / "workflow" / "scripts" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def merged(base, extra):
    """What Snakemake makes of --configfile: mappings are merged, everything else is replaced."""
    if not (isinstance(base, dict) and isinstance(extra, dict)):
        return extra
    return base | {key: merged(base.get(key), value) for key, value in extra.items()}


def read_settings(name):
    return yaml.safe_load((ROOT / "config" / f"{name}.yaml").read_text())
