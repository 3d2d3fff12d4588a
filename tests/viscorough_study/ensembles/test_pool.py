"""Pools of batches: an ensemble taken from a pool equals one large ensemble."""

import json

import numpy as np
import pytest

from support.study import aggregate, line_curve
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.ensembles.pool import aggregate_curves, ensembles, select
from viscorough_study.ensembles.realization import Realization

X = abscissa(1e-3, 3, 10)
RMS = np.linspace(0.8, 1.2, 12)


@pytest.fixture(scope="module")
def curves():
    heights = np.random.default_rng(1).normal(size=(12, 40))
    return [line_curve(gaps) for gaps in heights.max(axis=1, keepdims=True) - heights]


def batch(curves, rms, hurst=0.5, ensemble="a_c1", first=0, until_x=3.0, names=("a",)):
    """Return a batch as read_curves does; names : names in the settings of its ensembles"""
    members = [
        (Realization(ensemble, first + i, exponent, 1.0, 1 / curve.elements, {"line": height}, until_x), curve)
        for i, (curve, height, exponent) in enumerate(
            zip(curves, rms, np.broadcast_to(hurst, len(curves)), strict=True)
        )
    ]
    return members, [{"name": name} for name in names]


def test_ensemble_of_a_hurst_exponent_is_one_large_ensemble(curves):
    parts = ((slice(0, 5), "a_c1", 0), (slice(5, 9), "a_c2", 0), (slice(9, 12), "a_c2", 4))
    batches = [("base", batch(curves[part], RMS[part], ensemble=name, first=first)) for part, name, first in parts]
    other = ("variant", batch(curves[:2], RMS[:2], hurst=0.7, ensemble="b_c1"))
    pool = aggregate_curves([*batches, other], ["line"], X)
    pooled = ensembles(pool, "hurst")[0.5]
    whole = aggregate(curves, {"line": RMS}, 1.0, X, hurst=0.5, ensemble="a")
    assert set(pooled.data_vars) == set(whole.data_vars)
    for name in whole.data_vars:
        np.testing.assert_allclose(pooled[name], whole[name], rtol=1e-12, err_msg=name)
    assert pooled["ensemble"].values.tolist() == ["a_c1"] * 5 + ["a_c2"] * 7
    assert (pooled["hurst"].item(), pooled["elements"].item()) == (0.5, 40)
    by_name = ensembles(select(pool, group="base"), "ensemble")
    assert list(by_name) == ["a_c1", "a_c2"]
    second = aggregate(curves[5:], {"line": RMS[5:]}, 1.0, X, hurst=0.5, ensemble="a_c2")
    np.testing.assert_allclose(by_name["a_c2"]["velocity_geometric"], second["velocity_geometric"], rtol=1e-12)


def test_mean_is_over_the_curves_required_to_reach_its_abscissa(curves):
    """Shorter curves reach further by chance, depending on the surface; beyond their required end they do not count."""
    short = ("base", batch(curves[2:], RMS[2:], first=2, until_x=0.1))
    mean = ensembles(aggregate_curves([("base", batch(curves[:2], RMS[:2])), short], ["line"], X), "hurst")[0.5]
    whole = aggregate(curves[:2], {"line": RMS[:2]}, 1.0, X, hurst=0.5, ensemble="a")
    below, above = X < 0.11, X > 0.11
    assert mean["realizations_defined"].values[0, below].tolist() == [12] * below.sum()
    for name in ("velocity_geometric", "realizations_defined", "fraction_defined", "contact_count_median"):
        np.testing.assert_array_equal(mean[name].values[:, above], whole[name].values[:, above], err_msg=name)
    assert mean["fraction_defined"].values[0, 0] == 1


def test_batch_may_hold_several_ensembles(curves):
    """One file has realizations on two grids and with two Hurst exponents."""
    short = line_curve([0.0, 0.5, 1.0])
    first = batch([*curves[:2], short], np.ones(3), hurst=[0.5, 0.5, 0.7], ensemble="sizes", names=("a", "b"))
    other = batch([short], np.ones(1), hurst=0.7, ensemble="sizes", first=3, names=("b", "c"))
    mixed = aggregate_curves([("sizes", first), ("sizes", other)], ["line"], X)
    assert mixed["elements"].values.tolist() == [40, 40, 3, 3]
    assert mixed["hurst"].values.tolist() == [0.5, 0.5, 0.7, 0.7]
    assert [entry["name"] for entry in json.loads(mixed.attrs["settings"])] == ["a", "b", "c"]
    assert list(ensembles(mixed, "hurst", "elements")) == [(0.5, 40), (0.7, 3)]
    pooled = ensembles(mixed, "hurst", "elements")[0.5, 40]
    whole = aggregate(curves[:2], {"line": np.ones(2)}, 1.0, X, hurst=0.5, ensemble="a")
    np.testing.assert_array_equal(pooled["stiffness"], whole["stiffness"])
