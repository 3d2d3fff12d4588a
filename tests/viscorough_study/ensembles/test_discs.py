"""Discs of ensembles and their rms heights."""

import numpy as np
import pytest

from viscorough.surfaces.self_affine import cut_disc, self_affine_square
from viscorough_study.ensembles.discs import ensemble_disc
from viscorough_study.ensembles.pool import elements_across
from viscorough_study.run.seeds import realization_seed


@pytest.mark.parametrize("rms_over", ["disc", "square"])
def test_both_rms_heights_agree_with_the_surface(rms_over):
    surface = {"hurst": 0.4, "rms": 2e-6, "diameter": 1e-2, "period": 2.0, "rms_over": rms_over, "length_unit": "m"}
    seed = realization_seed(1, 1, 0)
    disc, rms = ensemble_disc(33, surface, seed)
    assert rms["disc"] == pytest.approx(np.nanstd(disc.heights), rel=1e-12)
    assert rms[rms_over] == pytest.approx(2e-6, rel=1e-12)
    square = self_affine_square(0.4, 66, seed=realization_seed(1, 1, 0))
    assert rms["disc"] / rms["square"] == pytest.approx(np.nanstd(cut_disc(square, 33)) / square.std(), rel=1e-12)
    assert disc.spacing == pytest.approx(1e-2 / 33)


@pytest.mark.parametrize("across", [16, 17])
def test_rms_height_of_the_ensemble_agrees_with_the_spectrum(across):
    """In this unit the mean square height over the square is 1 on average; with fixed amplitudes, in each disc."""
    surface = {"hurst": 0.9, "rms": 1.0, "diameter": 1.0, "rms_over": "disc", "length_unit": "1"}

    def squares(amplitudes, number):
        drawn = [ensemble_disc(across, surface | {"amplitudes": amplitudes}, seed)[1] for seed in range(number)]
        return np.array([(rms["square"] / rms["ensemble"]) ** 2 for rms in drawn])

    np.testing.assert_allclose(squares("fixed", 3), 1, rtol=1e-12)
    random = squares("random", 400)
    error = random.std(ddof=1) / np.sqrt(random.size)
    assert error < 0.04  # the mean square of a single realization scatters by more than half
    assert abs(random.mean() - 1) < 4 * error


def test_elements_across_follow_from_their_number():
    for across in (9, 64, 257):
        assert elements_across(np.isfinite(cut_disc(np.zeros((across, across)), across)).sum()) == across
