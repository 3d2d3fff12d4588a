"""Write files atomically, under a temporary name that is replaced by the final name when the content is complete."""

import contextlib
import os
import stat
import sys
import uuid
from collections.abc import Iterator
from pathlib import Path

from viscorough.basics.types import FilePath
from viscorough.io.refusals import reason


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
