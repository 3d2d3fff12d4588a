"""Files that must agree: profiles, lock files, files for archives and catalogs, and the making of the environment."""

import os
import re
import shutil
import subprocess
import sys
import tomllib

import pytest
import yaml

from support.workflow import ROOT, RULES, TEST, copy_project, jobs, plan, snakemake


def test_slurm_profile_gives_timed_jobs_a_node(tmp_path, finished_once):
    """Timed jobs have a node to themselves. The jobs equal those of a local run, except for the executor."""
    profile = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text())
    timed = {name for name, text in RULES.items() if "threads: ALL_CORES" in text}
    assert timed == set(profile["set-threads"])
    assert {profile["set-resources"][name]["slurm_extra"] for name in timed} == {"'--exclusive'"}
    assert profile.pop("executor") == "slurm"
    folder = copy_project(tmp_path)
    (folder / "local").mkdir()
    (folder / "local/config.yaml").write_text(yaml.safe_dump(profile))
    assert plan(folder, *TEST, "--profile", "local", "--", "all") == jobs((finished_once / "run.log").read_text())


def test_rules_scripts_logs_and_benchmarks_share_their_names():
    """Figures share one script. A rule that is derived from another one has its log and its benchmark."""
    scripts = {}
    for name, text in RULES.items():
        if '"results/logs/' in text:
            assert f'"results/logs/{name}' in text, name
            assert f'"results/benchmarks/{name}' in text, name
            assert "source=" in text, name
        if script := re.search(r'"\.\./scripts/(\w+)\.py"', text):
            scripts[name] = script[1]
    assert {name: script for name, script in scripts.items() if name != script} == {"plot_surfaces": "plot"}
    files = {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / "workflow/scripts").glob("*.py")}
    assert set(scripts.values()) == set(files)
    assert max(text.count("\n") for text in files.values()) <= 40


def test_every_rule_is_found_by_its_name(unmade):
    """Snakemake lists no rule that a loop or a function made."""
    listed = snakemake(unmade, "--list", cores=None)
    names = set(re.findall(r"^(\w+)(?: \(.*\))?$", listed, re.MULTILINE))
    assert names == set(RULES)


def test_lock_files_agree_with_each_other():
    """All are installed into one environment, so no package may be in two files. No file may hold an address."""
    texts = {path.name: path.read_text() for path in ROOT.glob("requirements*.lock")}
    packages = {name: set(re.findall(r"^([\w.-]+)==", text, re.MULTILINE)) for name, text in texts.items()}
    assert set(packages) == {"requirements.lock", "requirements-dev.lock", "requirements-slurm.lock"}
    assert sum(map(len, packages.values())) == len(set.union(*packages.values()))
    assert "://" not in "".join(texts.values())
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"] | {"": project["dependencies"]}
    for extra, requirements in extras.items():
        lock = "requirements-slurm.lock" if extra == "slurm" else "requirements-dev.lock"
        further = set() if extra in ("", "build", "study", "plot") else packages[lock]
        names = {re.match(r"[\w.-]+", requirement)[0].lower().replace("_", "-") for requirement in requirements}
        assert names <= packages["requirements.lock"] | further, extra


def test_missing_venv_is_one_line_and_leaves_no_files(tmp_path):
    """Debian without python3-venv behaves so."""
    shutil.copy(ROOT / "Makefile", tmp_path)
    shutil.copytree(ROOT / "peers", tmp_path / "peers")
    (tmp_path / "requirements.lock").touch()
    python = tmp_path / "python"
    python.write_text('#!/bin/sh\ncase "$2" in *ensurepip*) echo Traceback >&2; exit 1;; esac\n')
    python.chmod(0o755)
    command = ["make", "environment", f"PYTHON={python}"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.splitlines()[0].endswith("are needed; Debian and Ubuntu: apt install python3-venv")
    assert "Traceback" not in done.stderr
    assert not (tmp_path / ".venv").exists()


def python_of_version(folder, version, lines=""):
    """Write a program that is this Python but states another version, and has no venv; lines : run first"""
    numbers = tuple(map(int, version.split(".")))
    python = folder / "python"
    python.write_text(
        f"#!{sys.executable}\nimport sys\nsys.version, sys.version_info = '{version} (main)', {numbers}\n{lines}\n"
        "exec(sys.argv[2]) if sys.argv[1] == '-c' else sys.exit(1)\n"
    )
    python.chmod(0o755)
    return python


@pytest.mark.parametrize(
    ("version", "refused"), [("3.10.9", True), ("3.11.0", False), ("3.14.1", False), ("3.15.0", True)]
)
def test_interpreters_outside_the_tested_range_are_refused(tmp_path, version, refused):
    """The interpreter is this Python, which states another version."""
    shutil.copy(ROOT / "Makefile", tmp_path)
    shutil.copytree(ROOT / "peers", tmp_path / "peers")
    (tmp_path / "requirements.lock").touch()
    python = python_of_version(tmp_path, version)
    command = ["make", "environment", f"PYTHON={python}"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    message = f"Python 3.11 to 3.14 is needed, and {python} is {version}; make PYTHON=... names another one\n"
    assert done.stderr.startswith(message) == refused
    assert (message in done.stderr) == refused
    assert not (tmp_path / ".venv").exists()


@pytest.mark.parametrize(("version", "refused"), [("3.13.0", False), ("3.14.0", True)])
def test_missing_compiler_is_reported_before_anything_is_installed(tmp_path, version, refused):
    shutil.copy(ROOT / "Makefile", tmp_path)
    shutil.copytree(ROOT / "peers", tmp_path / "peers")
    (tmp_path / "requirements.lock").touch()
    python = python_of_version(tmp_path, version, "import shutil; shutil.which = lambda name: None")
    command = ["make", "environment", f"PYTHON={python}"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ("immutables, which has no wheel for Python 3.14: a C compiler" in done.stderr.split("\n")[0]) == refused
    assert not (tmp_path / ".venv").exists()


@pytest.fixture
def built(tmp_path):
    """Make a folder with a Makefile and an environment that is up to date."""
    shutil.copy(ROOT / "Makefile", tmp_path)
    shutil.copytree(ROOT / "peers", tmp_path / "peers")
    (tmp_path / ".venv/bin").mkdir(parents=True)
    for name in ("requirements.lock", "pyproject.toml", ".venv/lock-installed", ".venv/package-installed"):
        (tmp_path / name).touch()
    (tmp_path / ".venv/bin/pip").write_text(f"#!{tmp_path}/.venv/bin/python3.11\n")
    return tmp_path


def make_environment(folder, target="environment"):
    command = ["make", "--dry-run", target]
    own = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, env=own)


def test_only_tests_and_lint_install_their_packages(built):
    (built / "requirements-dev.lock").touch()
    assert "pip install" not in make_environment(built, "reproduce").stdout
    assert "requirements-dev.lock" in make_environment(built, "lint").stdout


def test_moved_environment_is_built_again(built):
    """Programs of the environment contain the path of the folder in which it was built."""
    assert "venv" not in make_environment(built).stdout
    moved = built.rename(built.with_name(f"{built.name}-moved"))
    assert "python3 -m venv --clear .venv\n" in make_environment(moved).stdout


@pytest.mark.parametrize(("name", "named"), [("my folder", "a space"), ("Lin's", "'")])
def test_folder_in_which_no_job_can_start_is_refused_by_make(built, name, named):
    done = make_environment(built.rename(built.with_name(name)))
    assert done.returncode == 2
    assert done.stdout == ""
    assert f"{name}: the path has {named}, with which no job can start; " in done.stderr
    assert done.stderr.count("\n") == 1


def test_caches_are_in_the_project_if_the_home_folder_is_missing(built):
    """Otherwise Snakemake ends with a traceback, or makes a folder named ~."""
    (built / "Makefile").write_text((built / "Makefile").read_text() + "\nshow:\n\t@echo $$XDG_CACHE_HOME\n")
    for home, cache in (
        (str(built), ""),
        (str(built / "none"), f"{built}/.snakemake/cache"),
        ("", f"{built}/.snakemake/cache"),
    ):
        own = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "XDG_CACHE_HOME")}
        command = ["make", "--no-print-directory", "show"]
        done = subprocess.run(command, cwd=built, capture_output=True, text=True, check=True, env=own | {"HOME": home})
        assert done.stdout == f"{cache}\n"


def test_citation_agrees_with_package_and_changelog():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert (citation["version"], citation["license"]) == (project["version"], project["license"])
    assert f"## {project['version']} ({citation['date-released']})\n" in (ROOT / "CHANGELOG.md").read_text()


def test_container_has_the_files_that_its_commands_need(tmp_path):
    """The files that Containerfile copies suffice to plan its commands."""
    commands = re.findall(r"^(COPY|RUN|CMD) (.*)", (ROOT / "Containerfile").read_text(), re.MULTILINE)
    for sources, target in (text.rsplit(maxsplit=1) for kind, text in commands if kind == "COPY"):
        for source in map(ROOT.joinpath, sources.split()):
            if source.is_dir():
                shutil.copytree(source, tmp_path / target, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
            else:
                (tmp_path / target).mkdir(exist_ok=True)
                shutil.copy(source, tmp_path / target)
    assert commands[-2:] == [("RUN", "make environment"), ("CMD", '["make", "reproduce"]')]
    for command in ("environment", "reproduce"):
        subprocess.run(["make", "--dry-run", command], cwd=tmp_path, check=True, capture_output=True)
    snakemake(tmp_path, "--dry-run")
