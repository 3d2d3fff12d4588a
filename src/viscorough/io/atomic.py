"""Files written atomically: under a temporary name, which becomes the final one when the content is complete.

Also what files, read or written, must be.
"""

import contextlib
import functools
import glob
import os
import platform
import stat
import sys
import uuid
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

import psutil

from viscorough.types import FilePath

_LONGEST_REASON = 250  # letters of an error, which may quote what a file holds


def reason(error: BaseException) -> str:
    """The message of an error, on one line."""
    return " ".join(str(getattr(error, "strerror", None) or error).split())


@contextlib.contextmanager
def path_named(path: FilePath) -> Iterator[None]:
    """Context in which the message of a ValueError gets the path in front, unless it starts with it."""
    try:
        yield
    except ValueError as error:
        text = str(error)
        raise ValueError(text if text.startswith(f"{path}: ") else f"{path}: {text}") from error


@contextlib.contextmanager
def reading(path: FilePath, needed: str) -> Iterator[None]:
    """Context in which a file is read: any fault of it becomes a one-line ValueError, which says what is needed.

    Damage raises errors of many kinds in the libraries that read files. Opening a pipe would wait for a writer, and a
    device may have no end. A lack of memory is no fault of the file.
    """
    try:
        mode = os.stat(path).st_mode
        if not stat.S_ISREG(mode):
            kind = "a pipe" if stat.S_ISFIFO(mode) else "a folder" if stat.S_ISDIR(mode) else "a device"
            raise ValueError(f"it is {kind}")
        yield
    except MemoryError:
        raise
    except Exception as error:
        raise ValueError(f"{path}: not readable ({reason(error)[:_LONGEST_REASON]}); {needed}") from error


def check_output(path: FilePath) -> Path:
    """The path with links resolved, so that a link's target is replaced and not the link.

    Raises ValueError unless the folder exists and is writable, the path does not exist yet or is a regular file, and
    its name is text (NetCDF libraries take no other).
    """
    target, folder = Path(os.path.realpath(path)), Path(path).parent
    try:
        str(target).encode(sys.getfilesystemencoding())
    except UnicodeEncodeError as error:
        raise ValueError(f"{path}: the name is no text in {error.encoding}; another name is needed") from error
    if not target.parent.is_dir():
        raise ValueError(f"{path}: there is no folder {folder}; an existing folder is needed")
    if not os.access(target.parent, os.W_OK | os.X_OK):
        raise ValueError(f"{path}: the folder {folder} is not writable; a writable folder is needed")
    if target.exists() and not target.is_file():
        raise ValueError(f"{path}: is not a regular file; a new file or one to be replaced is needed")
    return target


@contextlib.contextmanager
def atomic_write(path: FilePath) -> Iterator[Path]:
    """Context that yields a temporary path beside `path`; the file written there replaces `path` on success.

    A file that is replaced keeps its permissions. On an error the temporary file is removed and `path` is not changed.
    Temporary files that killed processes left for the same path are removed, too, if this process can tell that they
    are not alive. Raises what check_output raises, and OSError if writing fails.
    """
    target = check_output(path)
    stem = f".{os.fsencode(target.name)[:60].decode(errors='ignore')}.{_place()}"
    temporary = target.with_name(f"{stem}.{os.getpid()}.{uuid.uuid4().hex[:8]}.part")
    for leftover in target.parent.glob(f"{glob.escape(stem)}.*.part"):
        process = leftover.name.removeprefix(stem).split(".")[1]
        with contextlib.suppress(OSError, OverflowError):  # somebody else removed it; no number of a process
            if process.isdecimal() and not psutil.pid_exists(int(process)):
                leftover.unlink()
    try:
        yield temporary
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())  # a full or remote disk may report its failure only here
        if target.exists():
            temporary.chmod(stat.S_IMODE(target.stat().st_mode))
        os.replace(temporary, target)
    except (OSError, RuntimeError) as error:  # the NetCDF library raises RuntimeError where the disk is full
        cause = reason(_error_of_plain_writing(temporary) or error)
        raise OSError(f"{path}: not written ({cause}); room on a writable disk is needed") from error
    finally:
        temporary.unlink(missing_ok=True)


def _error_of_plain_writing(path: FilePath) -> OSError | None:
    """The error where a file cannot be continued; the NetCDF library calls a full disk a denied permission."""
    try:
        with open(path, "ab") as file:
            file.write(bytes(2**20))
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        return error
    return None


@functools.cache
def _place() -> str:
    """A name for where the numbers of processes are those that this process sees: a running system or a container.

    Systems that share a disk, or containers, may have one host name, so the name holds those of the system's start and
    of the namespace of process numbers where the system (Linux) tells them.
    """
    identity = [platform.node()]
    with contextlib.suppress(OSError):
        identity += [Path("/proc/sys/kernel/random/boot_id").read_text(), os.readlink("/proc/self/ns/pid")]
    return sha256("".join(identity).encode(errors="surrogateescape")).hexdigest()[:12]
