"""What `make bench` measures with: the stopwatch, the operators that are compared."""

import pkgutil
import sys
import time
from types import SimpleNamespace

import numpy as np
import pytest

from viscorough import self_affine_disc


@pytest.fixture(scope="module")
def curves(script):
    return script("curves")


def test_every_part_is_a_function(curves):
    for parts in (curves.PARTS_OF_CURVE, curves.PARTS_OF_LINE):
        for name in (name for names in parts.values() for name in names):
            assert callable(pkgutil.resolve_name(name)), name


def test_every_part_takes_time_and_is_restored(curves):
    """The dense solver and the grid, on a disc of enough elements for both."""
    functions = [pkgutil.resolve_name(name) for names in curves.PARTS_OF_CURVE.values() for name in names]
    disc = self_affine_disc(0.6, 65, seed=1)
    shares = curves.shares(lambda: curves.indent(disc), curves.PARTS_OF_CURVE)
    assert all(shares[part] > 0 for part in curves.PARTS_OF_CURVE)
    assert sum(share for part, share in shares.items() if part != "processor_s") == pytest.approx(1)
    assert functions == [pkgutil.resolve_name(name) for names in curves.PARTS_OF_CURVE.values() for name in names]


def test_a_curve_takes_longer_than_its_operators(curves):
    (row,) = curves.over_operators([0.6], 65, 1)
    assert row["ratio"] > 1
    disc = self_affine_disc(0.6, 65, seed=3)
    assert row["operators"] == curves.indent(disc, until_fraction=curves.UNTIL).operator_applications


def test_stopwatch_counts_the_time_within(curves, monkeypatch):
    def work():
        end = time.process_time() + 0.02
        while time.process_time() < end:
            pass

    module = SimpleNamespace(work=work)
    monkeypatch.setitem(sys.modules, "stand_in", module)
    with curves.stopwatch({"work": ["stand_in.work"]}) as seconds:
        start = time.process_time()
        module.work()
        module.work()
        whole = time.process_time() - start
        work()  # not through the module: not counted
    assert module.work is work
    assert 0.04 <= seconds["work"] <= whole  # a busy machine may make both longer


def test_columns_by_ducc0_are_the_same_convolution(curves):
    rows, length = 17, curves.good_length(32)
    spectrum = np.random.default_rng(1).random((length // 2 + 1, 5))
    whole = spectrum[np.minimum(np.arange(length), length - np.arange(length))]
    data = np.random.default_rng(2).random((rows, 5)) + 0j
    expected = curves.ducc0_columns(data, whole)
    curves.ColumnConvolution(rows, spectrum / length, float).apply(data)
    np.testing.assert_allclose(data, expected, rtol=1e-12)
