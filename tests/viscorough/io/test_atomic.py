"""Files are replaced when their content is complete, and not touched before."""

import os
import shutil

import pytest

from support.contract import refused
from viscorough.io.atomic import atomic_write, check_output


def write(path, text, error=None):
    with atomic_write(path) as temporary:
        temporary.write_text(text)
        if error:
            raise error


def test_writing_to_a_link_replaces_its_target(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "folder" / "real")
    write(tmp_path / "link", "content")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "folder" / "real").read_text() == "content"


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, TypeError])
def test_interrupted_writing_leaves_the_older_file(tmp_path, interruption):
    path = tmp_path / "curve"
    path.write_text("older")
    with pytest.raises(interruption):
        write(path, "half", interruption())
    assert path.read_text() == "older"
    assert os.listdir(tmp_path) == ["curve"]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), RuntimeError("NetCDF: HDF error")])
def test_failed_writing_is_one_line(tmp_path, error):
    with pytest.raises(OSError, match=r"a\.csv: not written .*; room on a writable disk is needed$"):
        write(tmp_path / "a.csv", "half", error)
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("mode", [None, 0o600, 0o444])
@pytest.mark.parametrize("name", ["é" * 120, "a" * 255])
def test_permissions_are_kept_for_names_of_any_length(tmp_path, mode, name):
    path, plain = tmp_path / name, tmp_path / "plain"
    plain.write_text("older")
    if mode is not None:
        plain.chmod(mode)
        shutil.copy(plain, path)
    write(path, "newer")
    assert path.read_text() == "newer"
    assert path.stat().st_mode == plain.stat().st_mode


def test_paths_that_cannot_be_written(tmp_path):
    """The test of the whole command, in a namespace without privileges, covers folders without permission to write."""
    (tmp_path / "folder").mkdir()
    os.mkfifo(tmp_path / "pipe")  # a pipe, like /dev/null, must never be replaced by a file
    for name, what in {
        "none/a.nc": "there is no folder",
        "folder": "is not a regular file",
        "pipe": "is not a regular file",
        os.fsdecode(b"caf\xe9.nc"): "the name is no text in utf-8",
    }.items():
        with refused(what):
            check_output(tmp_path / name)
        with refused(what):
            write(tmp_path / name, "")
    assert sorted(os.listdir(tmp_path)) == ["folder", "pipe"]
