"""Run loops over large arrays on several threads of the process.

Compiled loops and Fourier transforms release Python's global interpreter lock, so several blocks of an array can be
processed at the same time. The division into blocks does not depend on the number of threads, and the results of blocks
are combined in the order of the blocks. Computed numbers are therefore the same to the last bit for any number of
threads.
"""

import os
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

# Largest number of array entries in a block. A map of 257 x 257 elements fits into one block, so it needs no threads.
BLOCK = 1 << 17
# Size of a line of the processor's cache in bytes.
_CACHE_LINE = 64


def run_blocks(
    function: Callable[[int, int], Any], size: int, threads: int, block: int = BLOCK, multiple: int = 1
) -> list[Any]:
    """Divide range(size) into blocks, call function(start, stop) for every block, and return the results in order.

    The calls run on up to `threads` threads.

    function : function that releases Python's global interpreter lock while it computes, and that does not write to
        array entries which the call for another block reads
    size : number of entries to divide
    block : largest number of entries in a block, a multiple of `multiple`
    multiple : the number of entries in every block except the last is a multiple of this number
    """
    if size <= block:
        return [function(0, size)]
    # Use an even number of blocks of equal size, so that two threads take the same time even if there are few blocks.
    count = -(-size // (2 * block)) * 2
    block = -(-size // (count * multiple)) * multiple
    starts = range(0, size, block)
    results, remaining = [None] * len(starts), iter(enumerate(starts))

    def work() -> None:
        for number, start in remaining:
            results[number] = function(start, min(start + block, size))

    helpers = min(threads, len(starts)) - 1
    pending = [_helpers(os.getpid(), threads - 1).submit(work) for _ in range(helpers)]
    try:
        work()
    finally:
        for helper in pending:
            # Cancel helpers that have not started, because no block is left for them. Wait for helpers that have
            # started: cancel() returns False for these.
            if not helper.cancel():
                helper.result()
    return results


def aligned_zeros(shape: tuple[int, ...], dtype: DTypeLike) -> NDArray[Any]:
    """Return an array of zeros that starts at the beginning of a cache line; loops access such arrays faster."""
    size = int(np.prod(shape)) * np.dtype(dtype).itemsize
    memory = np.zeros(size + _CACHE_LINE, np.uint8)
    start = -memory.ctypes.data % _CACHE_LINE
    return memory[start : start + size].view(dtype).reshape(shape)


class Buffer(threading.local):
    """Scratch array `array`, separate for each thread.

    Each thread first sees an array of zeros, and later the values that the same thread has written.
    """

    def __init__(self, shape: tuple[int, ...], dtype: DTypeLike) -> None:
        self.array = aligned_zeros(shape, dtype)


@lru_cache(maxsize=1)
def _helpers(_process: int, threads: int) -> ThreadPoolExecutor:
    """Return the pool of threads that work in addition to the calling thread.

    The pool is cached by the id of the process, because a forked process cannot use the threads of its parent.
    """
    return ThreadPoolExecutor(threads, thread_name_prefix="viscorough")
