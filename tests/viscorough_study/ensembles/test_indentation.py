"""Curves of realizations, as the scripts compute them, and the stiffness of flat discs."""

import warnings

import numpy as np
import pytest

from support.workflow import load_script, read_settings
from viscorough.contact.loading_path import indent
from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles.curve_files import read_curves
from viscorough_study.ensembles.discs import ensemble_disc
from viscorough_study.ensembles.flat_punch import punch_stiffness
from viscorough_study.ensembles.realization import Realization
from viscorough_study.ensembles.surface_files import write_surfaces
from viscorough_study.run import samples

INDENTATION = {"tolerance": 1e-3, "until_x": 3.0, "short_until_x": 0.1, "whole": 1}


def curves_of(kind, folder, batch):
    """Return {name: values} in the file of curves that the scripts make of a batch; discs pass through a file."""
    if kind == "lines":
        load_script("reduce_lines").main(folder / "curves.nc", ensembles=batch, seed=7, until_x=30.0)
    else:
        load_script("generate_discs").main(folder / "surfaces.nc", ensembles=batch, seed=7)
        load_script("indent_surfaces").main(folder / "surfaces.nc", folder / "curves.nc", indentation=INDENTATION)
    return {name: variable.values for name, variable in read_dataset(folder / "curves.nc").variables.items()}


@pytest.mark.parametrize("kind", ["discs", "lines"])
def test_realization_is_the_same_in_every_batch(tmp_path, kind):
    settings = read_settings("config")
    table, size = (
        (samples.disc_samples, {"elements": 17}) if kind == "discs" else (samples.line_samples, {"points": 512})
    )
    ensembles = [ensemble | size for ensemble in samples.batch_ensembles(table(settings)["h04000"], "0000-0002")[-2:]]
    curves = {}
    for first in (0, 2):
        batch = [ensemble | {"numbers": [first, 3]} for ensemble in ensembles]
        values = curves_of(kind, tmp_path, batch)
        names, numbers = values["ensemble"].tolist(), values["number"].tolist()
        force = [row[np.isfinite(row)] for row in values["force"]]
        curves[first] = dict(zip(zip(names, numbers, strict=True), force, strict=True))
    for key, force in curves[2].items():
        np.testing.assert_array_equal(curves[0][key], force)
    assert not np.array_equal(*list(curves[0].values())[:2])


def test_dimensionless_discs_have_no_unit_and_give_no_warning(tmp_path):
    """Heights of the size of the diameter would be an error in metres, but are normal in dimensionless units."""
    settings = read_settings("config")
    (ensemble,) = samples.batch_ensembles(samples.disc_samples(settings)["h04000_roll_off"], "0000-0001")
    with warnings.catch_warnings(action="error"):
        curves_of("discs", tmp_path, [ensemble | {"elements": 17}])
    variables = read_dataset(tmp_path / "curves.nc").variables
    assert np.nanmax(variables["depth"].values) > variables["diameter"].values, "the depth is that of ordinary discs"
    lengths = ("depth", "stiffness", "spacing", "diameter", "rms_disc", "rms_square")
    assert {variables[name].attrs["units"] for name in lengths} == {"1"}


def test_first_curves_of_every_ensemble_extend_further(tmp_path):
    settings = read_settings("config")
    ensembles = samples.batch_ensembles(samples.disc_samples(settings)["h09000"], "0000-0002")[:2]
    batch = [ensemble | {"elements": 17} for ensemble in ensembles]
    values = curves_of("discs", tmp_path, batch)
    assert values["until_x"].tolist() == [3.0, 0.1, 0.1] * 2
    largest_rms = np.maximum(values["rms_disc"], values["rms_square"])
    ends = np.nanmax(values["force"], axis=1) / (4 * largest_rms * values["diameter"])
    assert (ends >= values["until_x"]).all()
    assert (ends < 1.5 * values["until_x"]).all()


@pytest.mark.parametrize("until_x", [0.003, 0.3])
def test_curves_of_lines_end_at_the_first_level_beyond_their_x(tmp_path, until_x):
    ensembles = samples.batch_ensembles(samples.line_samples(read_settings("config"))["h04000"], "0000-0002")[:1]
    (batch,) = ensembles = [ensemble | {"points": 4096} for ensemble in ensembles]
    load_script("reduce_lines").main(tmp_path / "curves.nc", ensembles=ensembles, seed=7, until_x=until_x)
    length = batch["surface"]["length"]
    for realization, curve in read_curves(tmp_path / "curves.nc")[0]:
        x = curve.force / (4 * batch["surface"]["rms"] * length)
        assert x[-1] >= until_x > x[-2]
        assert realization[3:] == (length, pytest.approx(length / 4096), {"line": batch["surface"]["rms"]}, until_x)


def test_stiffness_of_a_flat_disc_converges_to_the_punch_at_first_order():
    errors = np.array([(1 - punch_stiffness(across)) * across for across in (33, 65, 129)])
    np.testing.assert_allclose(errors, 1.3, rtol=0.05)


def test_curve_is_computed_from_the_exact_surface(tmp_path):
    """The comparison is bit by bit: the file of a surface loses nothing. A measured surface has only one rms height."""
    surface = {"hurst": 0.5, "rms": 1.7, "diameter": 33.0, "period": 1.5, "rms_over": "disc", "length_unit": "m"}
    disc, rms = ensemble_disc(17, surface, 3)
    for known in (rms, {"disc": rms["disc"]}):
        realization = Realization("disc", 0, 0.5, 33.0, disc.spacing, known)
        write_surfaces([({}, 1, [(realization, disc)])], tmp_path / "surfaces.nc")
        files = tmp_path / "surfaces.nc", tmp_path / "curves.nc"
        load_script("indent_surfaces").main(*files, indentation=INDENTATION)
        until_force = 4 * max(known["disc"], known.get("square", 0.0)) * 33.0 * INDENTATION["until_x"]
        curve = indent(disc, tolerance=1e-3, until_fraction=1.0, until_force=until_force)
        made = read_dataset(files[1]).variables
        np.testing.assert_array_equal(made["force"].values[0], curve.force)
        np.testing.assert_array_equal(made["stiffness"].values[0], curve.stiffness)
