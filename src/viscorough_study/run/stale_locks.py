"""Remove stale locks of Snakemake: locks that killed runs leave behind and that would block the next run.

Snakemake writes no process number into its locks, so a lock does not show whether its run is alive. Every Snakemake in
a folder, and every job, therefore also holds a shared lock of the operating system on one file, which is released
whenever the process ends. A process that obtains this lock exclusively knows that all runs in the folder, and all of
their jobs, have ended. A job outlives its run if only the run is killed. It would overwrite the results of the next
run, so the locks remain until it has ended.

A job holds the lock when its imports have ended. Processes that are still importing are found by their command line.
"""

import contextlib
import fcntl
import os
import sys
from pathlib import Path

import psutil

ALIVE = Path(".snakemake/alive")
REMOVED = "The last run in this folder was killed: its lock is removed, its results are kept."


def remove_stale_locks(*, unlock=False):
    """Remove Snakemake's locks from the working directory unless another Snakemake, or a job, is running there.

    unlock : True if Snakemake was started to remove all locks (--unlock)

    Returns the descriptor of an open file, whose lock marks this process as running until it ends. Returns None if the
    folder cannot be written, or if its file system does not support such locks. No lock is removed then, since nothing
    shows whether it is stale; Snakemake shows its own message on locks.

    Raises ValueError, with `unlock`, if another Snakemake or a job is running.
    """
    try:
        ALIVE.parent.mkdir(exist_ok=True)
        alive = os.open(ALIVE, os.O_RDWR | os.O_CREAT)
        try:
            fcntl.flock(alive, fcntl.LOCK_EX | fcntl.LOCK_NB)
            is_alone = True
        except BlockingIOError:
            is_alone = False
        stale = list(ALIVE.parent.glob("locks/*.lock"))
        jobs = _jobs() if stale else []
        if unlock and stale and (jobs or not is_alone):
            os.close(alive)
            working = f"a job (process {', '.join(map(str, jobs))})" if jobs else "another Snakemake"
            raise ValueError(f"{os.getcwd()}: {working} still runs in this folder; wait until it has ended, or stop it")
        if stale and is_alone and not jobs:
            print(REMOVED, file=sys.stderr)
            for path in stale:
                path.unlink(missing_ok=True)
        fcntl.flock(alive, fcntl.LOCK_SH)
    except OSError:
        return None
    return alive


def mark_as_running():
    """Mark this process, a job, as running in the working directory until it ends; see `remove_stale_locks`."""
    with contextlib.suppress(OSError):  # no such folder in a test, or no locks
        fcntl.flock(os.open(ALIVE, os.O_RDWR), fcntl.LOCK_SH)


def _jobs():
    """Return the process numbers of all jobs of Snakemake that work in this folder."""
    processes = psutil.process_iter(["cwd", "cmdline"])
    return [
        process.pid
        for process in processes
        if process.info["cwd"] == os.getcwd()
        and any(".snakemake/scripts/" in word for word in process.info["cmdline"] or ())
    ]
