"""Make faults of files and disks, and read the contents of folders, which faults must not change."""

import os
import shutil
import subprocess

import pytest

DAMAGES = {
    "truncated": lambda whole: whole[: len(whole) // 2],
    "bit in the header": lambda whole: whole[:36] + bytes([whole[36] ^ 1]) + whole[37:],
    "second half zeros": lambda whole: whole[: len(whole) // 2] + bytes(len(whole) - len(whole) // 2),
}


def no_privileges():
    """Return the prefix of a command that applies file permissions to it, which root ignores."""
    return [] if os.geteuid() else namespace("--user")


def namespace(*options):
    """Return the prefix of a command that runs it in new namespaces; skip the test if the system has none."""
    unshare = ["unshare", *options]
    if not shutil.which("unshare") or subprocess.run([*unshare, "true"], capture_output=True, check=False).returncode:
        pytest.skip("needs user namespaces")
    return unshare


def contents(folder):
    """Return {path in the folder: bytes} of all files except logs and benchmarks."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and not {"logs", "benchmarks"} & set(path.parts)
    }
