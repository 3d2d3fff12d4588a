"""`viscorough reduce`: curves of lines and of maps by the method of dimensionality reduction."""

import numpy as np
import pytest

import viscorough
from support.command_line import run
from viscorough import Indenter, load_curve, mdr, self_affine_disc, self_affine_line
from viscorough.io.datasets import read_dataset

LINE = self_affine_line(0.6, 512, rms=0.2, length=128.0, seed=3)
IN_METRES = Indenter(LINE.heights.astype(float) * 1e-6, 2.5e-7, length_unit="m")
DISC = self_affine_disc(0.6, 17, rms=0.2, diameter=17.0, seed=3)


@pytest.fixture(autouse=True)
def here(here):
    np.save("line.npy", LINE.heights)
    np.save("map.npy", DISC.heights)
    return here


def test_reduce_reads_a_line_from_a_file(capsys):
    assert run("reduce line.npy --spacing '250 nm' --unit um --until-fraction 0.5 -o curve.nc") == 0
    assert "curves" not in capsys.readouterr().out
    curve = load_curve("curve.nc")
    assert curve.length_unit == "m"
    np.testing.assert_allclose(curve.force, mdr.reduce(IN_METRES, until_fraction=0.5).force, rtol=1e-12)
    assert curve.contact_fraction[-2] < 0.5 <= curve.contact_fraction[-1]


def test_reduce_warns_of_a_measured_profile(capsys):
    np.savetxt("line.txt", LINE.heights)
    assert run("reduce line.txt --spacing 0.25 --unit um -o curve.nc") == 0
    assert "line.txt: a line cut from a measured surface is stiffer than the surface" in capsys.readouterr().err
    np.testing.assert_allclose(load_curve("curve.nc").force, mdr.reduce(IN_METRES).force, rtol=1e-12)
    viscorough.save(LINE, "line.nc")
    assert run("reduce line.nc -o curve.nc") == 0
    assert capsys.readouterr().err == ""


def test_map_gives_many_lines_and_a_warning(capsys):
    assert run("reduce map.npy --spacing 1 --unit 1 --realizations 3 --seed 7 -o curves.nc") == 0
    said, warning = capsys.readouterr()
    assert "3 curves, the first with " in said
    content = read_dataset("curves.nc")
    assert "not the curve of this surface" in warning
    assert content.attrs["warnings"] in warning
    depths, levels = (content.variables[name].values for name in ("depth", "levels"))
    assert len(depths) == 3
    for index, (depth, number) in enumerate(zip(depths, levels, strict=True)):
        expected = mdr.reduce(mdr.line_of_map(Indenter(DISC.heights, 1.0), [7, index]))
        np.testing.assert_array_equal(depth[:number], expected.depth)
    assert run("reduce map.npy --spacing 1 --unit 1 --seed 7 -o one.nc") == 0
    assert run("kinetics one.nc --force 1 --viscosity 1 -o motion.nc") == 0
