"""Loops over blocks on several threads, and the contact solver on them: the same numbers for any number of threads."""

import os
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import numpy as np
import pytest

from viscorough import Indenter, contact_at, indent, self_affine_disc
from viscorough.contact.parallel import Buffer, aligned_zeros, run_blocks
from viscorough.contact.ranking import all_elements

DISC = self_affine_disc(0.8, 401, seed=1)  # a disc of several blocks


@pytest.mark.parametrize("threads", [1, 3, 1000])
@pytest.mark.parametrize("size", [0, 1, 10, 11, 95])
def test_blocks_cover_the_range_and_results_are_in_order(size, threads):
    blocks = run_blocks(lambda start, stop: (start, stop), size, threads, block=10)
    assert [i for start, stop in blocks for i in range(start, stop)] == list(range(size))
    assert all(stop - start <= 10 for start, stop in blocks)


def test_blocks_are_an_even_number_of_about_one_size():
    for size in (11, 25, 95):
        sizes = run_blocks(lambda start, stop: stop - start, size, 1, block=10)
        assert len(sizes) % 2 == 0
        assert max(sizes) - min(sizes) < len(sizes)
    *sizes, _ = run_blocks(lambda start, stop: stop - start, 95, 2, block=12, multiple=4)
    assert set(sizes) == {12}


def test_aligned_zeros_start_a_line_of_the_cache():
    for shape, dtype in (((5,), np.float32), ((3, 7), np.float64), ((2, 40, 33), np.float32)):
        zeros = aligned_zeros(shape, dtype)
        assert (zeros.shape, zeros.dtype) == (shape, dtype)
        assert zeros.ctypes.data % 64 == 0
        assert not zeros.any()


def test_blocks_run_at_the_same_time():
    barrier = threading.Barrier(3)  # three threads must wait together to pass
    run_blocks(lambda start, stop: barrier.wait(timeout=10), 3, 3, block=1)


@pytest.mark.parametrize("threads", [1, 3])
def test_errors_in_a_block_are_raised(threads):
    with pytest.raises(ZeroDivisionError):
        run_blocks(lambda start, stop: 1 / (start - 50), 100, threads, block=10)


def test_nested_loops_end():
    def inner(start, stop):
        return sum(run_blocks(lambda first, last: last - first, 40, 2, block=10))

    assert run_blocks(inner, 40, 2, block=10) == [40] * 4


def test_a_forked_process_starts_other_threads():
    run_blocks(lambda start, stop: None, 20, 2, block=10)
    child = os.fork()
    if child == 0:
        failed = 1
        try:
            barrier = threading.Barrier(2)
            run_blocks(lambda start, stop: barrier.wait(timeout=10), 2, 2, block=1)
            failed = 0
        finally:
            os._exit(failed)  # whatever happens, the child must not run the tests that follow
    deadline = time.monotonic() + 30
    while (done := os.waitpid(child, os.WNOHANG)) == (0, 0):
        assert time.monotonic() < deadline
        time.sleep(0.01)
    assert done[1] == 0


def test_threads_have_separate_buffers():
    buffer = Buffer((3,), float)
    with ThreadPoolExecutor(1) as pool:
        others = [pool.submit(lambda: buffer.array).result() for _ in range(2)]
    assert others[0] is others[1] is not buffer.array
    assert buffer.array.tolist() == others[0].tolist() == [0, 0, 0]


@pytest.mark.parametrize("digits", [2, 17])
def test_elements_are_ranked_by_gap_and_ties_by_place(digits):
    heights = (
        np.random.default_rng(1).random((400, 400)).round(digits)
    )  # rounding to these digits gives maps with and without equal heights
    expected = np.argsort((heights.max() - heights).ravel(), kind="stable")
    for threads in (1, 3, 100):
        elements = all_elements(Indenter(heights, 1.0), threads)
        np.testing.assert_array_equal(elements.row * 400 + elements.column, expected)
        assert np.all(np.diff(elements.initial_gap) >= 0)


def test_curve_and_contact_do_not_depend_on_the_number_of_threads():
    for compute in (partial(indent, until_fraction=0.1), partial(contact_at, force=1.0, tolerance=1e-6)):
        assert compute(DISC, threads=1) == compute(DISC, threads=3)


@pytest.mark.parametrize("threads", [0, 1.0, None, True, 1025])
def test_invalid_numbers_of_threads_are_refused(threads):
    for compute in (indent, partial(contact_at, depth=1.0)):
        with pytest.raises(ValueError, match="threads must be a whole number from 1 to 1024, not "):
            compute(Indenter(np.zeros((3, 3)), 1.0), threads=threads)
