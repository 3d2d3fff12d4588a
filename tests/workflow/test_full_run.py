"""Results of one full run of the small settings."""

import re

import numpy as np
import xarray as xr

from support.cf import violations
from support.workflow import FIGURES, TABLES, TEST, copy_kernels, jobs, snakemake
from viscorough_study.run.tables import read_table, split_table


def made(files, finished):
    """Return the names of the files whose rule was part of the run; files : {name: its rule}"""
    rules = jobs((finished / "run.log").read_text())
    return {name for name, rule in files.items() if rule in rules}


def test_every_figure_and_table_is_made(finished_once):
    results = finished_once / "results"
    assert {path.stem for path in (results / "figures").iterdir()} == made(FIGURES, finished_once)
    assert {path.stem for path in (results / "tables").glob("*.csv")} == made(TABLES, finished_once)
    for figure in (results / "figures").iterdir():
        assert figure.read_bytes().startswith(b"\x89PNG")
    for table in made(TABLES, finished_once):
        assert split_table(results / f"tables/{table}.csv")[0]["made_with"]["versions"]["viscorough"]
    assert (results / "tables/validation_passed.txt").read_text().splitlines()[1] == "sphere force"


def test_files_follow_the_cf_conventions(finished_once):
    """The test checks a file of every kind: curves of discs and lines, pools, examples."""
    files = [path for path in (finished_once / "results").rglob("*.nc") if "curves" not in path.parts]
    files += [finished_once / f"results/curves/{sample}/0000-0001.nc" for sample in ("discs/h04000", "lines/h04000")]
    assert len(files) == 3 + 1 + 2
    for path in files:
        assert violations(path) == [], path


def test_small_scale_states_that_its_verdicts_mean_nothing(finished_once):
    claims = split_table(finished_once / "results/tables/claims.csv")[0]
    assert [claims[name] for name in ("trial", "elements_across", "realizations")] == [1, 33, 4]
    assert "the verdicts mean nothing" in claims["scale"]


def test_neither_surfaces_of_ensembles_nor_incomplete_files_are_left(finished_once):
    assert [path.name for path in (finished_once / "results/surfaces").rglob("*.nc")] == ["examples.nc"]
    assert not list((finished_once / "results").rglob("*.part"))


def test_every_job_has_a_log_and_a_benchmark(finished_once):
    def stems(folder, suffix):
        paths = (finished_once / folder).rglob(f"*{suffix}")
        return {path.relative_to(finished_once / folder).with_suffix("") for path in paths}

    number = sum(jobs((finished_once / "run.log").read_text()).values())
    logs = stems("results/logs", ".log")
    assert logs == stems("results/benchmarks", ".tsv")
    assert len(logs) == number


def test_no_log_holds_a_warning(finished_once):
    logs = (finished_once / "results/logs").rglob("*.log")
    lines = [line for path in logs for line in path.read_text().splitlines()]
    assert any(" INFO " in line for line in lines), "no job has logged"
    assert [line for line in lines if "Warning" in line or " WARNING " in line] == []


def test_timed_jobs_ran_alone(finished_once):
    timed, running, most = ("Cost and error of every method", "Cost and error of every model of one surface"), {}, 0
    log = (finished_once / "run.log").read_text()
    for job, message, finished in re.findall(r"^Job (\d+): (.*)$|^Finished jobid: (\d+)", log, re.MULTILINE):
        running.pop(finished, None)
        if job:
            running[job] = message
            most = max(most, len(running))
            assert len(running) == 1 or not any(job.startswith(timed) for job in running.values()), running
    assert most > 1, "else it would not show that timed jobs run alone"


def test_no_job_reads_an_undeclared_file(finished_once):
    """A change of such a file would not run the job again."""
    assert (finished_once / "undeclared.txt").read_text(encoding="utf-8") == ""


def test_scaling_table_has_every_ensemble(finished_once):
    table = read_table(finished_once / "results/tables/scaling.csv")
    ensembles = set(table[["source", "group", "hurst"]].itertuples(index=False, name=None))
    assert ensembles == {
        (source, group, hurst)
        for source, group in (("discs", "base"), ("discs", "longer_period"), ("lines", "base"))
        for hurst in (0.4, 0.9)
    }
    # Both combinations are pooled. Only discs of the base group have lines to compare with.
    assert set(table.loc[table["group"] == "base"].query("source == 'discs'")["realizations"]) == {4}
    with_lambda = table.dropna(subset=["lambda"])
    assert set(with_lambda["source"]) == {"discs"}
    assert set(with_lambda["group"]) == {"base"}
    assert set(table.loc[table["reading"] == "B", "group"]) == {"longer_period"}


def test_combinations_are_in_real_units(finished_once):
    with xr.open_dataset(finished_once / "results/curves/discs/h04000/0000-0001.nc") as curves:
        ninth = curves.isel(realization=np.flatnonzero(curves["ensemble"] == "h04000_c9"))
        assert ninth.sizes["realization"] == 2
        np.testing.assert_array_equal(ninth["diameter"], 0.03)
        np.testing.assert_allclose(ninth["spacing"], 0.03 / 33)
        np.testing.assert_allclose(ninth["rms_disc"], 3e-7)
        assert curves["force"].attrs["units"] == "m2"
        assert "spawn_key" in curves.attrs["settings"]


def test_report_needs_no_number_of_cores(finished):
    """Like --unlock and --summary."""
    snakemake(finished, *TEST, "--report", "report.html", cores=None)
    page = (finished / "report.html").read_text()
    for text in ("fig4_exponent.png", "4 Conventions and validation"):
        assert text in page


def test_failed_validation_stops_the_workflow(finished, tmp_path):
    copy_kernels(finished, tmp_path)
    strict = tmp_path / "strict.yaml"
    strict.write_text("validation: {limits: {area: 1.0e-4}}\n")
    text = snakemake(finished, *TEST, strict, "--directory", tmp_path, "--", "require_validation", fails=True)
    assert "validation failed, see results/tables/validation.csv: sphere area: error" in text
    assert "cone area" in text
    table = read_table(tmp_path / "results/tables/validation.csv")
    assert not table.loc[table["quantity"] == "area", "passed"].any()
    assert not (tmp_path / "results/tables/validation_passed.txt").exists()
