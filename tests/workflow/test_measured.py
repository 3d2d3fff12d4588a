"""Measured surfaces named in the settings pass through the workflow together with the generated ones."""

import shutil

import numpy as np
import pytest

import support.tables
from support.cf import violations
from support.command_line import run
from support.workflow import TEST, jobs, plan, settings_file, snakemake
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.run.tables import read_table

pytestmark = pytest.mark.long

SCANS = {"ground_a", "ground_b", "polished_c"}
MADE = {"prepare_measured", "indent_surfaces", "aggregate_curves", "evaluate_measured", "plot_measured"}
MADE |= {"solve_measured_contacts"}
MADE |= {"make_page"}


def write_scans(folder):
    """Write three small maps in micrometres, and return the file of settings that names them."""
    (folder / "scans").mkdir()
    for seed, name in enumerate("abc"):
        heights = self_affine_disc(0.6, 25, rms=0.5, diameter=250.0, seed=seed).heights
        np.save(folder / f"scans/{name}.npy", heights)
    shared = {"spacing": [10.0], "unit": "um"}
    ground = {"name": "ground", "files": ["scans/[ab].npy"], "forces": [1e-3, 1e-4], **shared}
    ground["young_modulus"] = 2e6
    polished = {"name": "polished", "files": ["scans/c.npy"], "preparation": {"detrend": "plane"}, **shared}
    return settings_file(folder, "scans", measured=[ground, polished])


@pytest.fixture(scope="module")
def folder(finished_once, tmp_path_factory):
    """Make the finished project with three measured surfaces."""
    project = shutil.copytree(finished_once, tmp_path_factory.mktemp("measured") / "project")
    write_scans(project)
    output = snakemake(project, *TEST, "scans.yaml")
    assert set(jobs(output)) == MADE
    return project


def test_scans_are_evaluated_in_metres(folder):
    scans = read_table(folder / "results/tables/measured_scans.csv").set_index("scan")
    assert set(scans.index) == SCANS
    np.testing.assert_allclose(scans["spacing"], 1e-5)
    np.testing.assert_allclose(scans["rms"], 0.5e-6, rtol=0.2)
    np.testing.assert_allclose(scans["diameter"], 250e-6, rtol=0.06)  # coarse grid
    for path in (folder / "results").rglob("*measured*.nc"):
        assert violations(path) == [], path


def test_kinetics_have_all_forces_in_every_medium(folder):
    kinetics = read_table(folder / "results/tables/measured_kinetics.csv")
    assert set(kinetics["scan"]) == {"ground_a", "ground_b"}
    assert set(kinetics["force"]) == {1e-4, 1e-3}
    assert set(kinetics["medium"]) == {"newtonian", "springpot"}
    rows = kinetics.query("scan == 'ground_a' and medium == 'newtonian'")
    depths = rows.groupby((rows["force"] * rows["time"]).round(15))["depth"]
    np.testing.assert_allclose(depths.max(), depths.min(), rtol=1e-9)  # the depth depends only on the impulse
    assert (depths.size() == 2).sum() > 5


def test_contacts_have_the_numbers_of_the_command_line(folder, monkeypatch):
    monkeypatch.chdir(folder)
    contacts = read_table("results/tables/measured_contacts.csv")
    assert contacts["scan"].tolist() == ["ground_a", "ground_a", "ground_b", "ground_b"]
    how = "--spacing 10 --unit um --force 1e-4,1e-3 --young 2e6"
    assert run(f"contact scans/a.npy {how} -o {folder / 'contacts.csv'}") == 0
    table, units = support.tables.read_table("contacts.csv")
    for name in units:
        np.testing.assert_allclose(contacts[:2][name], table[name], rtol=1e-12, err_msg=name)


def test_scan_is_indented_again_if_its_content_changes(folder):
    heights = np.load(folder / "scans/b.npy")
    np.save(folder / "scans/b.npy", 1.1 * heights)
    planned = plan(folder, *TEST, "scans.yaml")
    assert planned == dict.fromkeys(MADE, 1)
    np.save(folder / "scans/b.npy", heights)
    assert plan(folder, *TEST, "scans.yaml") == {}, "its time does not count"
