"""What one full run of the small settings leaves behind."""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from support.cf import violations
from support.workflow import ROOT, TEST, load_script, plan, snakemake

FIGURES = ("fig1_surfaces", "fig2_kinetics", "fig3_master_curve", "fig4_exponent", "conventions", "validation")
FIGURES += ("prefactors", "interface", "direct", "reduction", "mdr_lambda", "speed", "failure_map", "level_placement")
FIGURES += ("media_exponents", "sizes", "collapse")
TABLES = (
    "scaling",
    "validation",
    "claims",
    "calibration",
    "prefactors",
    "zeta_laws",
    "literature",
    "direct",
    "reduction",
)
TABLES += ("plateaus", "interface")
TABLES += ("sizes", "sizes_trends", "collapse", "infinite_grid")
TABLES += ("mdr_lambda", "mdr_summary", "mdr_exponents")
TABLES += ("methods", "equal_error", "failure_map", "level_placement", "rule_costs", "media", "media_exponents")


def test_every_figure_and_table_is_made(finished):
    results = finished / "results"
    for figure in FIGURES:
        assert (results / f"figures/{figure}.png").read_bytes().startswith(b"\x89PNG")
        assert (results / f"figures/{figure}.pdf").read_bytes().startswith(b"%PDF")
    for table in TABLES:
        csv = pd.read_csv(results / f"tables/{table}.csv")
        with xr.open_dataset(results / f"tables/{table}.nc") as nc:
            assert set(nc.variables) == set(csv.columns)
        html = (results / f"tables/{table}.html").read_text()
        assert html.count("<tr>") == len(csv) + 1
    assert (results / "tables/validation_passed.txt").read_text().startswith("sphere force\n")


def test_files_follow_the_cf_conventions(finished):
    """One of every kind: curves of discs and lines, pools, examples, tables."""
    files = [path for path in (finished / "results").rglob("*.nc") if "curves" not in path.parts]
    files += [finished / f"results/curves/{case}/0000-0001.nc" for case in ("discs/h04000", "lines/h04000")]
    without_html = ("interface_curves", "collapse_curves")
    assert len(files) == 4 + 1 + len(TABLES) + len(without_html) + 2
    for path in files:
        assert violations(path) == [], path


def test_small_scale_says_that_its_verdicts_mean_nothing(finished):
    with xr.open_dataset(finished / "results/tables/claims.nc") as claims:
        assert (claims.trial, claims.elements_across, claims.realizations) == (1, 33, 4)
        assert "the verdicts mean nothing" in claims.scale
    assert "the verdicts mean nothing" in (finished / "results/tables/claims.html").read_text()


def test_surfaces_of_ensembles_are_not_stored(finished):
    assert [path.name for path in (finished / "results/surfaces").rglob("*.nc")] == ["examples.nc"]


def test_no_incomplete_file_is_left(finished):
    assert not list((finished / "results").rglob("*.part"))


def test_every_job_has_a_log_and_a_benchmark(finished, tmp_path):
    def stems(folder, suffix):
        paths = (finished / folder).rglob(f"*{suffix}")
        return {path.relative_to(finished / folder).with_suffix("") for path in paths}

    logs = stems("results/logs", ".log")
    assert logs == stems("results/benchmarks", ".tsv") - {Path("compile_kernels")}
    assert len(logs) == 60
    files = {kind: tmp_path / f"costs.{kind}" for kind in ("csv", "html", "nc")}
    load_script("tabulate_rule_costs").main(**files, benchmarks=finished / "results/benchmarks")
    table = pd.read_csv(files["csv"]).set_index("rule")
    assert table["jobs"].sum() == 60 + 1
    assert table.loc["indent_discs", "jobs"] == 8
    assert (table["longest_s"] <= table["seconds"]).all()
    assert table["seconds"].is_monotonic_decreasing


def test_scaling_table_has_every_ensemble(finished):
    table = pd.read_csv(finished / "results/tables/scaling.csv")
    ensembles = set(table[["source", "case_group", "hurst"]].itertuples(index=False, name=None))
    assert ensembles == {
        (source, group, hurst)
        for source, group in (("discs", "base"), ("discs", "longer_period"), ("lines", "base"))
        for hurst in (0.4, 0.9)
    }
    # Both combinations are pooled; only discs of the base group have lines to compare with.
    assert set(table.loc[table["case_group"] == "base"].query("source == 'discs'")["realizations"]) == {4}
    with_lambda = table.dropna(subset=["lambda"])
    assert set(with_lambda["source"]) == {"discs"}
    assert set(with_lambda["case_group"]) == {"base"}


def test_combinations_are_in_real_units(finished):
    with xr.open_dataset(finished / "results/curves/discs/h04000/0000-0001.nc") as curves:
        ninth = curves.isel(realization=np.flatnonzero(curves["case"] == "h04000_c9"))
        assert ninth.sizes["realization"] == 2
        np.testing.assert_array_equal(ninth["diameter"], 0.03)
        np.testing.assert_allclose(ninth["spacing"], 0.03 / 33)
        np.testing.assert_allclose(ninth["rms_disc"], 3e-7)
        assert curves["force"].attrs["units"] == "m2"
        assert "spawn_key" in curves.attrs["settings"]


def test_kernels_are_compiled_before_the_jobs(finished):
    """Once for these sources: the stamp holds their digest."""
    assert re.fullmatch(r"[0-9a-f]{16}", (finished / ".snakemake/kernels").read_text())
    assert list((ROOT / "src/viscorough/contact/__pycache__").glob("grid_*.nbi"))
    assert list((ROOT / "src/viscorough/__pycache__").glob("mdr.*.nbi"))


def test_a_second_run_has_nothing_to_do(finished):
    assert plan(finished, *TEST) == {}


def test_deleted_curves_are_made_again_by_a_target(finished):
    (finished / "results/curves/discs/h04000/0000-0001.nc").unlink()
    assert plan(finished, *TEST) == {}
    assert plan(finished, *TEST, "--", "curves") == {"indent_discs": 1}


def test_report(finished):
    snakemake(finished, *TEST, "--report", "report.html", cores=None)
    page = (finished / "report.html").read_text()
    for text in ("fig4_exponent.png", "scaling.html", "4 Conventions and validation", "collapse"):
        assert text in page


def test_report_with_other_settings_is_refused_in_one_line(finished):
    output = snakemake(finished, "--report", "report.html", cores=None, fails=True)
    assert output.splitlines()[-1].startswith("Error: results were not made with these settings and sources; run the")
    assert "Traceback" not in output
    assert not (finished / "report.html").exists()


def test_a_figure_by_its_name_leaves_the_others(finished):
    figures = [finished / f"results/figures/{name}.png" for name in ("fig4_exponent", "fig1_surfaces")]
    times = [figure.stat().st_mtime_ns for figure in figures]
    figures[0].unlink()
    snakemake(finished, *TEST, "--", "figure_4")
    assert figures[0].stat().st_mtime_ns > times[0]
    assert figures[1].stat().st_mtime_ns == times[1]


def test_a_failed_comparison_stops_the_workflow_and_is_named(finished, tmp_path):
    strict = tmp_path / "strict.yaml"
    strict.write_text("validation: {limits: {area: 1.0e-4}}\n")
    text = snakemake(finished, *TEST, strict, "--directory", tmp_path, "--", "validation", fails=True)
    assert "validation failed, see results/tables/validation.csv: sphere area: error" in text
    assert "cone area" in text
    table = pd.read_csv(tmp_path / "results/tables/validation.csv")
    assert not table.loc[table["quantity"] == "area", "passed"].any()
    assert not (tmp_path / "results/tables/validation_passed.txt").exists()
