"""Effect of the grid on κ at given u/h, for discs with given curves."""

import numpy as np
import pytest

from support.study import ensemble_of, pool_of
from viscorough_study.fits.grid_dependence import COLUMNS, grid_dependence

X = np.geomspace(1e-9, 30, 900)
GRIDS = {33: 8, 65: 6, 129: 4, 257: 3}  # elements across: number of discs


def table(prefactor, scatter=0.0, elements_min=10):
    """Fit discs with κ = prefactor(elements) X^(1/2), so that u/h = 2 X^(1/2)/prefactor and κ = prefactor² (u/h)/2."""
    random, members = np.random.default_rng(5), []
    for across, number in GRIDS.items():
        elements = round(np.pi / 4 * across**2)
        factor = prefactor(elements) * np.exp(scatter * random.standard_normal((number, 1)))
        stiffness = np.minimum(factor * np.sqrt(X), 1.0)
        count = np.maximum(elements * stiffness, 1.0)
        members.append(ensemble_of(X, stiffness, count, hurst=0.5, elements=elements))
    found = grid_dependence(pool_of(members, "sizes"), elements_min=elements_min, rms_convention="disc")
    assert list(found) == list(COLUMNS)
    return found.set_index(["quantity", "across"])


def test_fit_returns_values_and_factor_of_a_trend():
    found = table(lambda elements: 0.5 * elements**-0.1)
    for quantity, power, at in (("κ at u/h = 1", 2, 1 / 2), ("vt/h at X = 0.1", -1, np.sqrt(0.1))):
        rows = found.loc[quantity]
        expected = [at * (0.5 * round(np.pi / 4 * across**2) ** -0.1) ** power for across in GRIDS]
        np.testing.assert_allclose(rows["value"], expected, rtol=2e-3)
        assert rows["realizations"].tolist() == list(GRIDS.values())
    assert found.loc["κ at u/h = 1", "factor"].iloc[0] == pytest.approx(10**-0.2, rel=1e-2)


def test_interval_follows_from_the_scatter_of_all_discs():
    """The means are over 8, 6, 4 and 3 discs, on a line in log₁₀ n, with 17 degrees of freedom in all."""
    found = table(lambda elements: 0.5, scatter=0.1).loc["vt/h at X = 0.1"]
    elements, number = np.log10([round(np.pi / 4 * across**2) for across in GRIDS]), np.array(list(GRIDS.values()))
    offset = elements - np.average(elements, weights=number)
    error = 0.1 / np.sqrt(np.sum(number * offset**2))
    assert np.log(found["factor_high"] / found["factor_low"]).iloc[0] == pytest.approx(2 * 2.11 * error, rel=0.5)
    assert found["factor_low"].iloc[0] < 1 < found["factor_high"].iloc[0]


def test_grids_with_few_elements_in_contact_do_not_count():
    found = table(lambda elements: 0.5, elements_min=1000).loc["κ at u/h = 2"]
    assert found["compared"].tolist() == [0, 0, 1, 1]
    assert found["factor"].isna().all()
