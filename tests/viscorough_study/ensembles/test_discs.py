"""Surfaces and curves of realizations, as the scripts make them."""

import numpy as np
import pytest

from support.workflow import load_script, read_settings
from viscorough.io import netcdf
from viscorough.surfaces import cut_disc, self_affine_square
from viscorough_study.ensembles.discs import ensemble_disc, punch_stiffness
from viscorough_study.ensembles.pool import elements_across
from viscorough_study.run import cases
from viscorough_study.run.seeds import realization_seed


@pytest.mark.parametrize("rms_over", ["disc", "square"])
def test_both_rms_heights_are_those_of_the_surface(rms_over):
    surface = {"hurst": 0.4, "rms": 2e-6, "diameter": 1e-2, "period": 2.0, "rms_over": rms_over}
    seed = realization_seed(1, 1, 0)
    disc, rms = ensemble_disc(33, surface, seed)
    assert rms["disc"] == pytest.approx(np.nanstd(disc.heights), rel=1e-12)
    assert rms[rms_over] == pytest.approx(2e-6, rel=1e-12)
    assert rms["peak"] == pytest.approx(np.nanmax(disc.heights) - np.nanmean(disc.heights), rel=1e-12)
    square = self_affine_square(0.4, 66, seed=realization_seed(1, 1, 0))
    assert rms["disc"] / rms["square"] == pytest.approx(np.nanstd(cut_disc(square, 33)) / square.std(), rel=1e-12)
    assert disc.spacing == pytest.approx(1e-2 / 33)


def test_rms_height_of_the_ensemble_is_that_of_the_spectrum():
    """In its unit the mean square height over the square is 1 on average; with fixed amplitudes, in each."""
    surface = {"hurst": 0.9, "rms": 1.0, "diameter": 1.0, "rms_over": "disc"}

    def squares(amplitudes, number):
        drawn = [ensemble_disc(16, surface | {"amplitudes": amplitudes}, seed)[1] for seed in range(number)]
        return np.array([(rms["square"] / rms["ensemble"]) ** 2 for rms in drawn])

    np.testing.assert_allclose(squares("fixed", 3), 1, rtol=1e-12)
    random = squares("random", 400)
    error = random.std(ddof=1) / np.sqrt(random.size)
    assert error < 0.04  # a realization's own mean square scatters by more than half
    assert abs(random.mean() - 1) < 4 * error


ENDS = {"until_x": 3.0, "short_until_x": 0.1, "whole_curves": 1}
INDENTATION = {"tolerance": 1e-3, "until_fraction": 1.0} | ENDS


@pytest.mark.parametrize("kind", ["discs", "lines"])
def test_a_realization_is_the_same_in_every_batch(tmp_path, kind):
    settings = read_settings("config")
    table, size = (cases.disc_cases, {"elements": 17}) if kind == "discs" else (cases.line_cases, {"points": 512})
    about = {"seed": 7} | ({"indentation": INDENTATION} if kind == "discs" else {"until_x": 30.0})
    ensembles = [one | size for one in cases.ensembles_of_batch(table(settings)["h04000"], "0000-0002")[-2:]]
    curves = {}
    for first in (0, 2):
        batch = [ensemble | {"numbers": [first, 3]} for ensemble in ensembles]
        load_script(f"indent_{kind}").main(tmp_path / "curves.nc", ensembles=batch, **about)
        content = netcdf.read(tmp_path / "curves.nc")
        names, numbers = (content.variables[name].values.tolist() for name in ("case", "number"))
        force = [row[np.isfinite(row)] for row in content.variables["force"].values]
        curves[first] = dict(zip(zip(names, numbers, strict=True), force, strict=True))
    for key, force in curves[2].items():
        np.testing.assert_array_equal(curves[0][key], force)
    assert not np.array_equal(*list(curves[0].values())[:2])


def test_the_first_curves_of_every_ensemble_go_further(tmp_path):
    settings = read_settings("config")
    ensembles = cases.ensembles_of_batch(cases.disc_cases(settings)["h09000"], "0000-0002")[:2]
    batch = [ensemble | {"elements": 17} for ensemble in ensembles]
    load_script("indent_discs").main(tmp_path / "curves.nc", ensembles=batch, seed=7, indentation=INDENTATION)
    values = {name: one.values for name, one in netcdf.read(tmp_path / "curves.nc").variables.items()}
    assert values["until_x"].tolist() == [3.0, 0.1, 0.1] * 2
    largest_rms = np.maximum(values["rms_disc"], values["rms_square"])
    ends = np.nanmax(values["force"], axis=1) / (4 * largest_rms * values["diameter"])
    assert (ends >= values["until_x"]).all()
    assert (ends < 1.5 * values["until_x"]).all()


def test_stiffness_of_a_flat_disc_approaches_that_of_the_punch_at_first_order():
    errors = np.array([(1 - punch_stiffness(across)) * across for across in (33, 65, 129)])
    np.testing.assert_allclose(errors, 1.3, rtol=0.05)


def test_elements_across_follow_from_their_number():
    for across in (9, 64, 257):
        assert elements_across(np.isfinite(cut_disc(np.zeros((across, across)), across)).sum()) == across
