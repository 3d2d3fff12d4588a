"""Refuse files that cannot be read, in one line that names the file, its fault and the remedy."""

import contextlib
import os
import re
import stat
from collections.abc import Iterator

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


@contextlib.contextmanager
def path_named(path: FilePath) -> Iterator[None]:
    """Put the path in front of the message of a ValueError in a `with` block, unless the path is there already."""
    try:
        yield
    except ValueError as error:
        raise ValueError(_with_path(path, error)) from error


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
        raise Refused(_with_path(path, error)) from error
    except Exception as error:
        raise Refused(f"{path}: not readable ({_shortened(reason(error))}); {needed}") from error


def _with_path(path: FilePath, error: ValueError) -> str:
    """Return the message of an error with the path in front, unless the path is there already."""
    text = str(error)
    return text if text.startswith(f"{path}: ") else f"{path}: {text}"


def _shortened(text: str) -> str:
    """Return a text without its middle if it is longer than _LONGEST_REASON; its end may state the remedy."""
    half = _LONGEST_REASON // 2
    return text if len(text) <= _LONGEST_REASON else f"{text[:half]} … {text[-half:]}"
