"""Targets beside the default one, and the plans of every scale."""

import json
import re

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from support.workflow import TEST, copy_project, jobs, plan, settings_file, snakemake
from viscorough.surfaces import cut_disc

TIMED = ("Cost and error of every method", "The same levels by other solvers", "Placement of levels: by the package")


@pytest.fixture
def fresh(tmp_path):
    """A project in which nothing has been made."""
    return copy_project(tmp_path)


@pytest.fixture(scope="module")
def default_plan(unmade):
    return plan(unmade, *TEST)


def drawn(folder, *figures):
    """Whether the figures are there, with more in them than axes."""
    files = [folder / f"results/figures/{figure}.{kind}" for figure in figures for kind in ("png", "pdf")]
    return all(file.stat().st_size > 5000 for file in files)


@pytest.mark.parametrize(
    ("name", "indent_discs", "indent_lines"),
    [("config", 4 * (2 + 1) + 2, 22), ("paper", 4 * (8 + 8) + 4, 102), ("test", 2 * (1 + 1) + 4, 2 * 2 + 2)],
)
def test_plans_of_every_scale(unmade, name, indent_discs, indent_lines):
    planned = plan(unmade, "--configfile", f"config/{name}.yaml")
    assert (planned.pop("indent_discs"), planned.pop("indent_lines")) == (indent_discs, indent_lines)
    assert planned.pop("pool_curves") == 4
    assert planned.pop("measure_methods") == (2 if name == "test" else 3)
    assert set(planned.values()) == {1}
    assert {"check_validation", "fit_scaling", "judge_claims", "make_page"} < set(planned)
    assert indent_discs + indent_lines + sum(planned.values()) <= (100 if name == "config" else 250)


def test_one_figure_needs_only_its_own(unmade):
    assert plan(unmade, *TEST, "--", "figure_1") == {"generate_example_discs": 1, "plot_surfaces": 1}


def test_stability(fresh, default_plan):
    """From scripts to figures, on the smallest maps."""
    rules = ("map_failures", "plot_failure_map")
    assert jobs(snakemake(fresh, *TEST, "--", "stability")) == dict.fromkeys(rules, 1)
    assert drawn(fresh, "failure_map")
    table = pd.read_csv(fresh / "results/tables/failure_map.csv")
    with xr.open_dataset(fresh / "results/tables/failure_map.nc") as nc:
        assert nc["verdict"].values.tolist() == table["verdict"].tolist()
    assert "unnoticed" not in set(table["verdict"])


def test_sizes_and_large_discs(fresh, default_plan):
    """Ensembles on their own grids, which are part of the default run; cost of one disc, which is not."""
    planned = jobs(snakemake(fresh, *TEST, "--", "sizes", "large"))
    assert planned["indent_discs"] == 2 * planned["indent_lines"] == 2 * planned["measure_large"] == 4
    assert set(planned) - set(default_plan) == {"measure_large", "tabulate_large", "plot_large"}
    sizes = pd.read_csv(fresh / "results/tables/sizes.csv")
    discs = sizes[(sizes["source"] == "discs") & (sizes["case_group"] == "sizes")]
    assert set(sizes.loc[sizes["case_group"] == "controls", "elements"]) == set(discs["elements"])
    assert "finding" in pd.read_csv(fresh / "results/tables/sizes_trends.csv")
    assert dict(zip(discs["elements"], discs["realizations"], strict=True)) == {
        disc_elements(17): 3,
        disc_elements(33): 2,
    }
    assert sorted(set(sizes.loc[sizes["source"] == "lines", "elements"])) == [64, 1024]
    costs = pd.read_csv(fresh / "results/tables/large.csv")
    assert costs["across"].tolist() == [17, 33]
    assert costs["threads"].tolist() == [2, 2]
    assert (costs[["wall", "wall_threads"]] > 0).all(axis=None)
    assert (costs["memory"] > 1e7).all()
    assert drawn(fresh, "sizes", "large")


def run_beside(output):
    """[(message of a job, numbers of the jobs that ran at any time beside it)] of a run's output."""
    messages, beside, running = {}, {}, set()
    for job, message, finished in re.findall(r"^Job (\d+): (.*)$|^Finished jobid: (\d+)", output, re.MULTILINE):
        if finished:
            running.discard(finished)
            continue
        messages[job], beside[job] = message, set(running)
        for other in running:
            beside[other].add(job)
        running.add(job)
    return [(message, beside[job]) for job, message in messages.items()]


def disc_elements(across):
    return np.isfinite(cut_disc(np.zeros((across, across)), across)).sum()


def test_speed_without_other_solvers(fresh, default_plan):
    """Placement of levels and tables of few methods, from their scripts to the figures; then what needs no cores."""
    tasks = [{"name": "few", "elements": 17, "levels": 3, "fractions": [0.02, 0.5], "residual": 1e-6, "threads": [1]}]
    few = {"elements": [9], "bodies": ["sphere", "cone"], "bodies_elements": [9], "tasks": tasks}
    few["scenes"] = {"elements": 17, "hurst": 0.7}
    few_methods = (*TEST, settings_file(fresh, "few", methods=few))
    output = snakemake(fresh, *few_methods, "--", "speed")
    assert [beside for message, beside in run_beside(output) if message.startswith(TIMED)] == [set()] * 5
    assert any(beside for _, beside in run_beside(output)), "else it would not show that timed jobs run alone"
    planned = jobs(output)
    small = {"measure_methods", "tabulate_methods", "compare_level_placement", "plot_speed", "plot_level_placement"}
    assert set(planned) & set(default_plan) == small
    assert planned.pop("measure_methods") == 3  # sphere, cone, one rough disc
    tables = {"tabulate_methods", "time_other_solvers", "compare_level_placement"}
    plots = {"plot_speed", "plot_growth", "plot_other_solvers", "plot_level_placement"}
    assert planned == dict.fromkeys(tables | plots, 1)
    assert drawn(fresh, "speed", "growth", "other_solvers", "level_placement")
    methods = pd.read_csv(fresh / "results/tables/methods.csv")
    assert set(methods["problem"]) == {"sphere", "cone", "rough disc, H = 0.4"}
    assert not set(methods["group"]) & {"peer", "other solver"}
    with xr.open_dataset(fresh / "results/tables/other_solvers.nc") as table:
        assert json.loads(table.attrs["machine"])["cores"] >= 1
        assert table["solver"].values.tolist() == ["viscorough"]
    assert "is not installed: left out" in (fresh / "results/logs/time_other_solvers.log").read_text()
    for task in (("--unlock",), ("--summary",), ("--rulegraph",), ("--report", "report.html")):
        snakemake(fresh, *few_methods, *task, "--", "speed", cores=None)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("discs: {elemnts: 33}\n", "unknown key elemnts in discs; did you mean elements?"),
        ("# nothing\n", "Config file must be given as JSON or YAML with keys at top level."),
    ],
    ids=["misspelt", "empty"],
)
def test_wrong_settings_are_one_line_without_a_traceback(unmade, tmp_path, text, message):
    (tmp_path / "wrong.yaml").write_text(text)
    output = snakemake(unmade, "--dry-run", "--configfile", tmp_path / "wrong.yaml", fails=True)
    assert len([line for line in output.splitlines() if message in line]) == 1
    assert "Traceback" not in output
    assert "File " not in output
    # besides it: which profile is in use, that the file extends the default one, or the kind of error
    assert len(output.splitlines()) <= 3
