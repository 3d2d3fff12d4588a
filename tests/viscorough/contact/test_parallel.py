"""Loops over blocks on several threads, and the contact solver on them: the same numbers for any number of threads."""

from functools import partial

import numpy as np
import pytest

from viscorough import Indenter, contact_at, indent, self_affine_disc
from viscorough.contact.parallel import run_blocks


@pytest.mark.parametrize("threads", [1, 3, 1000])
@pytest.mark.parametrize("size", [0, 1, 10, 11, 95])
def test_blocks_cover_the_range_and_results_are_in_order(size, threads):
    blocks = run_blocks(lambda start, stop: (start, stop), size, threads, block=10)
    assert [i for start, stop in blocks for i in range(start, stop)] == list(range(size))
    assert all(stop - start <= 10 for start, stop in blocks)


@pytest.mark.parametrize("threads", [1, 3])
def test_errors_in_a_block_are_raised(threads):
    with pytest.raises(ZeroDivisionError):
        run_blocks(lambda start, stop: 1 / (start - 50), 100, threads, block=10)


def test_curve_and_contact_do_not_depend_on_the_number_of_threads():
    disc = self_affine_disc(0.8, 401, seed=1)  # a disc of several blocks
    for compute in (partial(indent, until_fraction=0.1), partial(contact_at, force=1.0, tolerance=1e-6)):
        one, three = (vars(compute(disc, threads=threads)) for threads in (1, 3))
        for name, value in one.items():
            np.testing.assert_array_equal(three[name], value, err_msg=name)


@pytest.mark.parametrize("threads", [0, 1.0, None, True, 1025])
def test_invalid_numbers_of_threads_are_refused(threads):
    for compute in (indent, partial(contact_at, depth=1.0)):
        with pytest.raises(ValueError, match="threads: must be a whole number from 1 to 1024, not "):
            compute(Indenter(np.zeros((3, 3)), 1.0), threads=threads)
