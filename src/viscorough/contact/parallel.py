"""Run loops over large arrays on several threads of the process.

Compiled loops and Fourier transforms release the interpreter's lock, so blocks of an array are processed at the same
time. The division of an array does not depend on the number of threads, and results of blocks are combined in their
order. So computed numbers are the same to the last bit for any number of threads.
"""

import os
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from viscorough.basics.arrays import is_whole, shown

# Entries of a block: a map of 257 x 257 elements is one block, so such maps take no more time.
BLOCK = 1 << 17
MOST_THREADS = 1024
# Bytes that the processor reads and writes at a time.
_CACHE_LINE = 64


def require_threads(name: str, threads: Any) -> None:
    """Raise ValueError, which starts with the name, unless `threads` is a whole number from 1 to MOST_THREADS."""
    if not is_whole(threads) or not 1 <= threads <= MOST_THREADS:
        raise ValueError(f"{name}: threads must be a whole number from 1 to {MOST_THREADS}, not {shown(threads)}")


def run_blocks(
    function: Callable[[int, int], Any], size: int, threads: int, block: int = BLOCK, multiple: int = 1
) -> list[Any]:
    """Call function(start, stop) for every block of range(size), on so many threads; return its results in order.

    function : releases the interpreter's lock while it computes, and writes to no entry that another block reads
    block : largest number of entries of a block, itself a multiple of `multiple`
    multiple : all blocks except the last have a multiple of this number of entries
    """
    if size <= block:
        return [function(0, size)]
    # An even number of blocks of equal size: two threads then take the same time even for few blocks.
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
            if not helper.cancel():  # a helper that has not started yet has nothing left to do
                helper.result()
    return results


def aligned_zeros(shape: tuple[int, ...], dtype: DTypeLike) -> NDArray[Any]:
    """Return an array of zeros whose first entry starts a line of the cache; loops then access it faster."""
    size = int(np.prod(shape)) * np.dtype(dtype).itemsize
    memory = np.zeros(size + _CACHE_LINE, np.uint8)
    start = -memory.ctypes.data % _CACHE_LINE
    return memory[start : start + size].view(dtype).reshape(shape)


class Buffer(threading.local):
    """A scratch array for every thread: zero when allocated, later as the thread has left it."""

    def __init__(self, shape: tuple[int, ...], dtype: DTypeLike) -> None:
        self.array = aligned_zeros(shape, dtype)


@lru_cache(maxsize=1)
def _helpers(_process: int, threads: int) -> ThreadPoolExecutor:
    """Return threads in addition to the calling thread; a forked process needs its own."""
    return ThreadPoolExecutor(threads, thread_name_prefix="viscorough")
