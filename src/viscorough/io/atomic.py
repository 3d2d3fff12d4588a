"""Write files atomically, and check files before they are read or written.

A file is written under a temporary name. It gets its final name when its content is complete.
"""

import contextlib
import errno
import fcntl
import functools
import glob
import os
import platform
import re
import stat
import sys
import uuid
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

import psutil

from viscorough.basics.types import FilePath

# Quote at most this many characters of the message of another library, which may repeat the content of a file.
_LONGEST_REASON = 300
# Messages of other libraries, and our words for them: {pattern: words}.
_TRANSLATIONS = {
    r"the magic string is not correct.*": "it does not begin like a .npy file",
    r"EOF: reading .*": "it ends too early",
    r"Header does not contain .*|Cannot parse header.*|Structure entry .*": "its header is damaged",
    r"NetCDF: Unknown file format": "it is no NetCDF file",
    r"NetCDF: (?:HDF|h5py) error.*|h5py error.*|Unable to (?:synchronously )?open .*|'\w+'": "its structure is damaged",
}
_NO_LOCKS = "its file system has no file locks; the environment variable HDF5_USE_FILE_LOCKING=FALSE is needed"


class Refused(ValueError):
    """Refusal of the content of a file, which states the remedy; `reading` adds the path to the message."""


def reason(error: BaseException) -> str:
    """Return the message of an error on one line, without internal words of common libraries."""
    text = " ".join(str(getattr(error, "strerror", None) or error).split())
    for pattern, words in _TRANSLATIONS.items():
        if re.fullmatch(pattern, text):
            return words
    return re.sub(r'in "<(?:byte|unicode) string>", (?=line|position)', "in ", text)


def _shortened(text: str) -> str:
    """Return a text without its middle if it is longer than _LONGEST_REASON; its end may state the remedy."""
    half = _LONGEST_REASON // 2
    return text if len(text) <= _LONGEST_REASON else f"{text[:half]} … {text[-half:]}"


def _lacks_locks(path: FilePath, error: BaseException) -> bool:
    """Return True if an error of reading or writing is due to a file system without file locks.

    The NetCDF library reports this as an error of the file's structure.
    """
    if not isinstance(error, OSError | RuntimeError):
        return False
    if getattr(error, "errno", None) == errno.ENOLCK:
        return True
    try:
        with open(path, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except OSError as fault:
        return fault.errno in (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP)
    return False


@contextlib.contextmanager
def path_named(path: FilePath) -> Iterator[None]:
    """Put the path in front of the message of a ValueError in a `with` block, unless the path is there already."""
    try:
        yield
    except ValueError as error:
        text = str(error)
        raise ValueError(text if text.startswith(f"{path}: ") else f"{path}: {text}") from error


@contextlib.contextmanager
def reading(path: FilePath, needed: str) -> Iterator[None]:
    """Turn every error in a `with` block that reads the file `path` into a one-line ValueError.

    Libraries raise errors of many kinds for a damaged file. A Refused keeps its message. Pipes and devices are refused:
    opening a pipe would wait for a writer, and a device may have no end. MemoryError is not changed, since it is no
    fault of the file.

    needed : end of the message, which states what the file must contain, such as "a whole NetCDF file is needed"
    """
    try:
        mode = os.stat(path).st_mode
        if not stat.S_ISREG(mode):
            kind = "a pipe" if stat.S_ISFIFO(mode) else "a folder" if stat.S_ISDIR(mode) else "a device"
            raise ValueError(f"it is {kind}")
        yield
    except MemoryError:
        raise
    except Refused as error:
        text = str(error)
        raise Refused(text if text.startswith(f"{path}: ") else f"{path}: {text}") from error
    except Exception as error:
        cause = _NO_LOCKS if _lacks_locks(path, error) else _shortened(reason(error))
        raise Refused(f"{path}: not readable ({cause}); {needed}") from error


def check_output(path: FilePath) -> Path:
    """Return the path with symbolic links resolved, so that writing replaces the target of a link and not the link.

    Raises ValueError if the folder is missing or not writable, if the path exists but is not a regular file, and if the
    path cannot be encoded as text, as the NetCDF library requires.
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
    """Yield a temporary path in the folder of `path`; the file written there replaces `path` on success.

    The new file has the permissions of the file that it replaces. After an error the temporary file is removed, and
    `path` is unchanged. Temporary files that earlier processes left for the same path are removed, too, if these
    processes have ended. Raises the errors of check_output, and OSError if writing fails.
    """
    target = check_output(path)
    stem = f".{os.fsencode(target.name)[:60].decode(errors='ignore')}.{_place()}"
    temporary = target.with_name(f"{stem}.{os.getpid()}.{uuid.uuid4().hex[:8]}.part")
    for leftover in target.parent.glob(f"{glob.escape(stem)}.*.part"):
        process = leftover.name.removeprefix(stem).split(".")[1]
        # OSError: another process has removed the file. OverflowError: no process can have so large a number.
        with contextlib.suppress(OSError, OverflowError):
            if process.isdecimal() and not psutil.pid_exists(int(process)):
                leftover.unlink()
    try:
        yield temporary
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())  # a full or remote disk may report an error only here
        if target.exists():
            temporary.chmod(stat.S_IMODE(target.stat().st_mode))
        os.replace(temporary, target)
    except (OSError, RuntimeError) as error:  # the NetCDF library raises RuntimeError for a full disk
        plain = _error_of_plain_writing(temporary)
        cause = _NO_LOCKS if plain is None and _lacks_locks(temporary, error) else reason(plain or error)
        raise OSError(f"{path}: not written ({cause}); room on a writable disk is needed") from error
    finally:
        temporary.unlink(missing_ok=True)


def _error_of_plain_writing(path: FilePath) -> OSError | None:
    """Try to append bytes to a file. Return the OSError, or None if writing succeeds.

    This error shows why an earlier attempt to write failed: the NetCDF library reports a full disk as a missing
    permission.
    """
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
    """Return a name for the system or container in which this process runs. Process numbers are unique there.

    Containers, and systems that share a disk, may have the same host name. On Linux the name therefore also depends on
    the identifier of the last start of the system, and on the identifier of the namespace of process numbers.
    """
    identity = [platform.node()]
    with contextlib.suppress(OSError):
        identity += [Path("/proc/sys/kernel/random/boot_id").read_text(), os.readlink("/proc/self/ns/pid")]
    return sha256("".join(identity).encode(errors="surrogateescape")).hexdigest()[:12]
