"""Targets other than the default, and the plans of every scale."""

import pytest

from support.workflow import ROOT, TEST, copy_kernels, copy_project, jobs, plan, settings_file, snakemake
from viscorough_study.run.tables import read_table


@pytest.mark.parametrize(
    ("name", "indent_surfaces", "reduce_lines"),
    [("config", 4 * (2 + 1 + 1) + 2, 11), ("paper", 4 * (8 + 1 + 1) + 2, 11 * 10)],
)
def test_large_scales_have_a_plan(unmade, name, indent_surfaces, reduce_lines):
    planned = plan(unmade, "--configfile", f"config/{name}.yaml")
    assert (planned.pop("indent_surfaces"), planned.pop("reduce_lines")) == (indent_surfaces, reduce_lines)
    assert planned.pop("generate_discs") == indent_surfaces
    assert planned.pop("aggregate_curves") == 3
    assert set(planned.values()) == {1}
    assert {"require_validation", "fit_scaling", "judge_claims", "make_page"} < set(planned)
    assert 2 * indent_surfaces + reduce_lines + sum(planned.values()) <= (90 if name == "config" else 300)


def test_settings_are_found_from_any_folder(tmp_path):
    """A file of settings is relative to the folder of the command, the default settings to the Snakefile."""
    settings_file(tmp_path, "mine", hurst=[0.33])
    here = ("--snakefile", ROOT / "Snakefile", "--directory", tmp_path / "out")
    planned = plan(tmp_path, *here, "--configfile", "mine.yaml", "--", "curves")
    assert planned == {"generate_discs": 4, "indent_surfaces": 4, "reduce_lines": 11}
    assert plan(tmp_path, *here, "--", "curves")["indent_surfaces"] == 4 * 4


@pytest.mark.long
def test_figure_plans_only_the_jobs_it_needs(unmade):
    assert plan(unmade, *TEST, "--", "figure_1") == {"generate_examples": 1, "plot_surfaces": 1}
    assert plan(unmade, *TEST, "--", "results/figures/fig1_surfaces.pdf") == {
        "generate_examples": 1,
        "plot_surfaces": 1,
    }


@pytest.mark.long
def test_fine_grids_are_a_target_of_their_own(finished_once, tmp_path):
    copy_kernels(finished_once, copy_project(tmp_path))
    finished = snakemake(tmp_path, *TEST, "--", "fine_grids")
    assert jobs(finished) == {"indent_nested": 4, "fit_fine_exponents": 1, "plot_local_exponent": 1}


def test_other_targets_are_made_together_with_the_default(finished):
    assert jobs(snakemake(finished, *TEST, "--", "speed", "stability")) == {}


def test_beyond_and_sensitivities_add_to_the_default_run_and_leave_its_page(finished):
    """The page shows published pictures, whatever lies in results/."""
    page = (finished / "results/index.html").read_bytes()
    done = jobs(snakemake(finished, *TEST, "--", "beyond", "sensitivities"))
    assert done.pop("indent_surfaces") == done.pop("generate_discs") == 1 + 2  # discs of the law, and of one variant
    assert done.pop("aggregate_curves") == 2
    assert set(done.values()) == {1}
    assert {"make_beyond_page", "tabulate_sensitivities", "tabulate_calibration"} < set(done)
    assert "fit_scaling" not in done
    table = read_table(finished / "results/tables/sensitivities.csv")
    assert set(table["surfaces"]) == {"base", "longer_period", "corners"}
    assert set(table["reading"].dropna()) == {"A", "B"}
    assert plan(finished, *TEST) == {}
    assert (finished / "results/index.html").read_bytes() == page
