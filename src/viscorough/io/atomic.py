"""Files written atomically: under a temporary name, which becomes the final one when the content is complete."""

import glob
import os
import platform
import uuid
from contextlib import contextmanager
from pathlib import Path

import psutil


def reason(error):
    """The message of an error, on one line."""
    return " ".join(str(getattr(error, "strerror", None) or error).split())


def check_output(path):
    """The path with links resolved, so that a link's target is replaced and not the link.

    Raises ValueError unless the folder exists and is writable, and the path does not exist yet or is a regular file.
    """
    target, folder = Path(os.path.realpath(path)), Path(path).parent
    if not target.parent.is_dir():
        raise ValueError(f"{path}: there is no folder {folder}; an existing folder is needed")
    if not os.access(target.parent, os.W_OK | os.X_OK):
        raise ValueError(f"{path}: the folder {folder} is not writable; a writable folder is needed")
    if target.exists() and not target.is_file():
        raise ValueError(f"{path}: is not a regular file; a new file or one to be replaced is needed")
    return target


@contextmanager
def atomic_write(path):
    """Context that yields a temporary path beside `path`; the file written there replaces `path` on success.

    On an error the temporary file is removed and `path` is not changed. Temporary files that killed processes of this
    machine left for the same path are removed, too. Raises what check_output raises, and OSError if writing fails.
    """
    target = check_output(path)
    stem = f".{target.name[:60]}.{platform.node()}"
    temporary = target.with_name(f"{stem}.{os.getpid()}.{uuid.uuid4().hex[:8]}.part")
    for leftover in target.parent.glob(f"{glob.escape(stem)}.*.part"):
        process = leftover.name.removeprefix(stem).split(".")[1]
        if process.isdecimal() and not psutil.pid_exists(int(process)):
            leftover.unlink(missing_ok=True)
    try:
        yield temporary
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())  # a full or remote disk may report its failure only here
        os.replace(temporary, target)
    except (OSError, RuntimeError) as error:  # the NetCDF library raises RuntimeError where the disk is full
        raise OSError(f"{path}: not written ({reason(error)}); room on a writable disk is needed") from error
    finally:
        temporary.unlink(missing_ok=True)
