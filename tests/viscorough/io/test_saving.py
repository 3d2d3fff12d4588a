"""Names of files for results: each suffix has one format, other suffixes are refused."""

import numpy as np
import pytest

import viscorough
from support.contract import refused
from viscorough.io import netcdf

DISC = viscorough.self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, seed=1)
CURVE = viscorough.indent(DISC)
MOTION = viscorough.kinetics(CURVE, 5e-6, 1e6, np.geomspace(0.1, 100, 50))
RESULTS = {
    "indenter": DISC,
    "curve": CURVE,
    "contact": viscorough.contact_at(DISC, depth=1e-6),
    "motion": MOTION,
    "medium": viscorough.identify_medium(CURVE, 5e-6, MOTION.time, MOTION.depth),
}


@pytest.mark.parametrize("name", ["result.xlsx", "result.txt", "result.h5", "result", "-", ".nc"])
@pytest.mark.parametrize("kind", RESULTS)
def test_other_suffixes_are_refused_and_no_file_is_left(tmp_path, kind, name):
    with refused(f"{name}: unknown kind of file"):
        viscorough.save(RESULTS[kind], tmp_path / name)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["result.nc", "result.NC"])
def test_suffix_of_netcdf_may_be_in_any_case(tmp_path, name):
    viscorough.save(CURVE, tmp_path / name)
    assert netcdf.read(tmp_path / name).variables["depth"].values.tolist() == CURVE.depth.tolist()


@pytest.mark.parametrize("name", ["result.csv", "result.CSV"])
def test_suffix_of_tables_may_be_in_any_case(tmp_path, name):
    viscorough.save(MOTION, tmp_path / name)
    rows = [line for line in (tmp_path / name).read_text().splitlines() if not line.startswith("#")]
    columns = np.genfromtxt(rows, delimiter=",", names=True)
    np.testing.assert_array_equal(columns["depth"], MOTION.depth)
