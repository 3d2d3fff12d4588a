"""Names of files for results: each suffix has one format, other suffixes are refused."""

import numpy as np
import pytest

import viscorough
from support.contract import refused
from support.tables import read_table
from viscorough.io.datasets import read_dataset

DISC = viscorough.self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, seed=1)
CURVE = viscorough.indent(DISC)
MOTION = viscorough.kinetics(CURVE, 5e-6, 1e6, np.geomspace(0.1, 100, 50))
RESULTS = {
    "indenter": DISC,
    "curve": CURVE,
    "contact": viscorough.contact_at(DISC, depth=1e-6),
    "motion": MOTION,
}


@pytest.mark.parametrize(
    ("kind", "name"),
    [*((kind, "result.xlsx") for kind in RESULTS), *(("curve", name) for name in ("result.txt", "result", "-", ".nc"))],
)
def test_other_suffixes_are_refused_and_no_file_is_left(tmp_path, kind, name):
    with refused(f"{name}: unknown kind of file"):
        viscorough.save(RESULTS[kind], tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_suffixes_may_be_in_any_case(tmp_path):
    viscorough.save(CURVE, tmp_path / "result.NC")
    assert read_dataset(tmp_path / "result.NC").variables["depth"].values.tolist() == CURVE.depth.tolist()
    viscorough.save(MOTION, tmp_path / "result.CSV")
    table, _ = read_table(tmp_path / "result.CSV")
    np.testing.assert_array_equal(table["depth"], MOTION.depth)


@pytest.mark.parametrize("kind", RESULTS)
def test_dataset_of_a_result_equals_its_file(tmp_path, kind):
    viscorough.save(RESULTS[kind], tmp_path / "result.nc")
    dataset, written = viscorough.to_dataset(RESULTS[kind]), read_dataset(tmp_path / "result.nc")
    assert set(dataset.coords) == set(written.coords)
    for name in dataset.attrs.keys() - {"history"}:
        np.testing.assert_array_equal(dataset.attrs[name], written.attrs[name])
    assert dataset.equals(written)
