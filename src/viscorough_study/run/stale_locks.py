"""Locks of Snakemake that killed runs left behind, which would stop the next run.

Snakemake writes no process number into its locks. So every Snakemake in a folder also holds a shared lock of the
operating system, which ends with its process however that ends. A process that gets that lock exclusively is
alone, and all locks of Snakemake that it finds belong to runs that were killed.
"""

import fcntl
import os
import sys
from pathlib import Path

REMOVED = "The last run in this folder was killed: its lock is removed, its results are kept."


def remove_stale_locks(folder=".snakemake"):
    """Remove Snakemake's locks from its folder unless another Snakemake is alive in it.

    Returns the descriptor of an open file, which marks this process as alive until it ends. Returns None where the
    folder cannot be written or its file system knows no such locks: there, Snakemake says what to do about its locks.
    """
    folder = Path(folder)
    try:
        folder.mkdir(exist_ok=True)
        alive = os.open(folder / "alive", os.O_RDWR | os.O_CREAT)
        try:
            fcntl.flock(alive, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            pass  # another Snakemake is alive
        else:
            _remove(folder / "locks")
        fcntl.flock(alive, fcntl.LOCK_SH)
    except OSError:
        return None
    return alive


def _remove(folder):
    if stale := list(folder.glob("*.lock")):
        for path in stale:
            path.unlink(missing_ok=True)
        print(REMOVED, file=sys.stderr)
