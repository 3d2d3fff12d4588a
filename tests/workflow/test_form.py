"""The form of the workflow: rules, scripts, profiles and lock files that go together."""

import re
import shutil
import subprocess

import yaml

from support.workflow import RESULTS, ROOT, TEST, copy_project, jobs, plan


def rules():
    """{rule: its text} of all rules with a script of their own."""
    text = "\n".join(path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk"))
    matches = re.findall(r"^rule (\w+):\n(.*?)(?=\n\S|\Z)", text, re.MULTILINE | re.DOTALL)
    return {name: body for name, body in matches if "script:" in body}


def tabulations(kind):
    """Rules of tables in results.yaml that are `queued`, or run `alone`."""
    return {name for name, rule in RESULTS["tables"].items() if rule.get(kind)}


def test_scripts_are_short_and_named_like_their_rules():
    scripts = {path.stem: path.read_text() for path in (ROOT / "workflow/scripts").glob("*.py")}
    assert set(scripts) == set(rules()) | {"plot", "tabulate", "show_tables"}  # these three serve many rules
    for name, text in rules().items():
        assert f'"../scripts/{name}.py"' in text
    for name, text in scripts.items():
        assert text.count("\n") <= 40, name
        assert re.search(r'^if job := globals\(\).get\("snakemake"\):$', text, re.MULTILINE), name


def test_short_rules_run_where_snakemake_runs():
    """Only what computes for long goes through a cluster's queue."""
    queued = {name for name, text in rules().items() if "localrule: True" not in text} | tabulations("queued")
    timed = {"measure_large", "measure_methods"} | tabulations("alone")
    curves = {"generate_discs", "prepare_measured", "indent_surfaces", "reduce_lines"}
    assert queued == timed | curves | {"validate", "compare_reduction", "compare_periodic", "map_failures"}


def test_timed_jobs_run_alone():
    """With all cores of a machine or, on a cluster, with a node that they do not share."""
    timed = {name for name, text in rules().items() if "threads: ALL_CORES" in text} | tabulations("alone")
    own = {"time_other_solvers", "time_light_contact", "compare_level_placement"}
    assert timed == {"measure_large", "measure_methods"} | own
    profile = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text())
    assert timed == set(profile["set-threads"])
    for name in timed:
        assert profile["set-resources"][name]["slurm_extra"] == "'--exclusive'"


def test_slurm_profile(tmp_path, finished_once):
    """It names existing rules, and plans what a local run did; without its executor, which is not installed."""
    profile = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text())
    for key in ("set-resources", "set-threads"):
        assert set(profile[key]) <= set(rules()) | set(RESULTS["tables"]), key
    assert profile.pop("executor") == "slurm"
    folder = copy_project(tmp_path)
    (folder / "local").mkdir()
    (folder / "local/config.yaml").write_text(yaml.safe_dump(profile))
    assert plan(folder, *TEST, "--profile", "local", "--", "all") == jobs((finished_once / "run.log").read_text())


def test_slurm_lock_goes_with_the_other_lock():
    """Both are installed into one environment, so no package may be in both; and neither may hold an address."""
    names = {}
    for name in ("requirements.lock", "requirements-slurm.lock"):
        text = (ROOT / name).read_text()
        names[name] = set(re.findall(r"^([\w.-]+)==", text, re.MULTILINE))
        assert "://" not in text
    assert "snakemake-executor-plugin-slurm" in names["requirements-slurm.lock"]
    assert not set.intersection(*names.values())


def test_missing_venv_is_one_line_and_leaves_nothing(tmp_path):
    """As on Debian without python3-venv."""
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
