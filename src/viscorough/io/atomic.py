"""Write files atomically, and check files before they are read or written.

A file is written under a temporary name. It gets its final name when its content is complete.
"""

import contextlib
import os
import re
import stat
import sys
import uuid
from collections.abc import Iterator
from pathlib import Path

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
        raise Refused(f"{path}: not readable ({_shortened(reason(error))}); {needed}") from error


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
    `path` is unchanged. Raises the errors of check_output, and OSError if writing fails.
    """
    target = check_output(path)
    stem = os.fsencode(target.name)[:60].decode(errors="ignore")
    temporary = target.with_name(f".{stem}.{uuid.uuid4().hex}.part")
    try:
        yield temporary
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())  # a full or remote disk may report an error only here
        if target.exists():
            temporary.chmod(stat.S_IMODE(target.stat().st_mode))
        os.replace(temporary, target)
    except (OSError, RuntimeError) as error:  # the NetCDF library raises RuntimeError for a full disk
        raise OSError(f"{path}: not written ({reason(error)}); room on a writable disk is needed") from error
    finally:
        temporary.unlink(missing_ok=True)
