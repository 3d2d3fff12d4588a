"""Remove stale locks of Snakemake: locks that killed runs leave behind and that would block the next run.

Snakemake writes no process number into its locks, so a lock does not show whether its run is alive. Every Snakemake in
a folder therefore also holds a shared lock of the operating system, which is released whenever the process ends. If a
process obtains this lock exclusively, then no other Snakemake is running, and all locks of Snakemake belong to killed
runs.
"""

import contextlib
import fcntl
import os
import sys
from pathlib import Path

REMOVED = "The last run in this folder was killed: its lock is removed, its results are kept."


def remove_stale_locks():
    """Remove Snakemake's locks from the working directory unless another Snakemake is running there.

    Returns the descriptor of an open file, whose lock marks this process as running until it ends. Returns None if the
    folder cannot be written, or if its file system does not support such locks; Snakemake then shows its own message on
    locks.
    """
    folder = Path(".snakemake")
    try:
        folder.mkdir(exist_ok=True)
        alive = os.open(folder / "alive", os.O_RDWR | os.O_CREAT)
        with contextlib.suppress(BlockingIOError):  # raised if another Snakemake is running
            fcntl.flock(alive, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if stale := list(folder.glob("locks/*.lock")):
                print(REMOVED, file=sys.stderr)
            for path in stale:
                path.unlink(missing_ok=True)
        fcntl.flock(alive, fcntl.LOCK_SH)
    except OSError:
        return None
    return alive
