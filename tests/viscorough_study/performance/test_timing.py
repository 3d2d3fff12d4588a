"""Time and memory of computations."""

import numpy as np

from viscorough_study.performance import timing


def test_repeats_are_interleaved_and_the_median_is_taken():
    calls = []
    result = timing.interleaved({name: lambda n=name: calls.append(n) for name in "ab"}, 3)
    assert calls == list("ababab")
    assert set(result) == {"a", "b"}
    assert min(result["a"]) >= 0


def test_memory_is_that_of_arrays():
    array, memory = timing.with_memory(lambda: np.ones(1_000_000))
    assert array.size == 1_000_000
    assert 8e6 <= memory < 9e6
