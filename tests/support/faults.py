"""Faults of files and disks, and what they may not harm."""

import os
import shutil
import subprocess

import pytest

# Fails in the middle of writing a file, as a full disk does.
NO_LARGE_FILES = "import os, resource, sys; size = int(sys.argv[1]); "
NO_LARGE_FILES += "resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)); os.execv(sys.argv[2], sys.argv[2:])"
DAMAGES = {
    "truncated": lambda whole: whole[: len(whole) // 2],
    "bit in the header": lambda whole: whole[:36] + bytes([whole[36] ^ 1]) + whole[37:],
    "half of it zeros": lambda whole: whole[: len(whole) // 2] + bytes(len(whole) - len(whole) // 2),
}


def no_privileges():
    """What to put before a command so that permissions hold for it, which they do not for root."""
    return [] if os.geteuid() else namespace("--user")


def namespace(*options):
    """What to put before a command for its own namespaces; skips where the system has none."""
    unshare = ["unshare", *options]
    if not shutil.which("unshare") or subprocess.run([*unshare, "true"], capture_output=True, check=False).returncode:
        pytest.skip("needs user namespaces")
    return unshare


def contents(folder):
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and not {"logs", "benchmarks"} & set(path.parts)
    }
