"""Time computations; repeats are interleaved, so changes of the machine's speed affect all computations alike."""

import os
import platform
import time
from pathlib import Path

import numpy as np


def interleaved(functions, repeats):
    """Time several functions; return {name: (wall, processor) seconds}, as medians over interleaved repeats.

    functions : {name: function without arguments}, all of which have run before
    repeats : number of calls of each function
    """
    times = [[timed(function)[1:] for function in functions.values()] for _ in range(repeats)]
    return dict(zip(functions, map(tuple, np.median(times, axis=0).tolist()), strict=True))


def timed(function):
    """Call a function, and return its result, its wall time and its processor time [s]."""
    wall, processor = time.perf_counter(), time.process_time()
    return function(), time.perf_counter() - wall, time.process_time() - processor


def machine():
    """Return the name, the processor and the number of cores of this machine, to be recorded with measured times."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.is_file() else []
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return {"name": platform.node(), "processor": names[0] if names else platform.processor(), "cores": os.cpu_count()}
