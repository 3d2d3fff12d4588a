"""What computations cost: interleaved repeats, so that a change of the machine's speed meets all of them alike."""

import gc
import os
import platform
import time
import tracemalloc
from pathlib import Path

import numpy as np


def interleaved(functions, repeats):
    """{name: (wall, processor) seconds} of functions, medians over interleaved repeats; each should have run before.

    A result with `seconds` of its own, such as those of another process, is taken by its word.
    """
    times = {name: [] for name in functions}
    for _ in range(repeats):
        for name, function in functions.items():
            result, *seconds = timed(function)
            times[name].append(getattr(result, "seconds", None) or seconds)
    return {name: tuple(np.median(each, axis=0).tolist()) for name, each in times.items()}


def timed(function):
    """Result of a function, and its wall and processor seconds."""
    wall, processor = time.perf_counter(), time.process_time()
    return function(), time.perf_counter() - wall, time.process_time() - processor


def with_memory(function):
    """Result of a function, and the most memory that its arrays took at any time [bytes]."""
    gc.collect()
    tracemalloc.start()
    try:
        return function(), tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def machine():
    """Name, processor and cores of this machine, for the files that times are written to."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.is_file() else []
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return {"name": platform.node(), "processor": names[0] if names else platform.processor(), "cores": os.cpu_count()}
