"""Files are replaced when their content is complete, and not touched otherwise."""

import os
import shutil

import pytest

from support.contract import refused
from viscorough.io.atomic import atomic_write, check_output, check_readable


def test_target_of_a_link_is_replaced_and_not_the_link(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "folder" / "real")
    with atomic_write(tmp_path / "link") as temporary:
        temporary.write_text("content")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "folder" / "real").read_text() == "content"


def write_half(path, error):
    with atomic_write(path) as temporary:
        temporary.write_text("half")
        raise error


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, TypeError])
def test_interrupted_writing_leaves_the_older_file(tmp_path, interruption):
    path = tmp_path / "curve"
    path.write_text("older")
    with pytest.raises(interruption):
        write_half(path, interruption())
    assert path.read_text() == "older"
    assert os.listdir(tmp_path) == ["curve"]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), RuntimeError("NetCDF: HDF error")])
def test_failed_writing_is_one_line(tmp_path, error):
    with pytest.raises(OSError, match=r"a\.csv: not written .*; room on a writable disk is needed$"):
        write_half(tmp_path / "a.csv", error)
    assert os.listdir(tmp_path) == []


def test_leftovers_of_killed_processes_are_removed_a_day_later(tmp_path):
    """They lie beside the target, else replacing would not be atomic; a recent one may belong to a live process."""
    old, recent = (tmp_path / f".a.csv.{letter * 32}.part" for letter in "ab")
    for file in (old, recent):
        file.write_text("half")
    os.utime(old, (0, 0))
    with atomic_write(tmp_path / "a.csv") as temporary:
        temporary.write_text("complete")
        assert (temporary.parent, len(temporary.name)) == (tmp_path, len(recent.name))
    assert sorted(tmp_path.iterdir()) == [recent, tmp_path / "a.csv"]


@pytest.mark.parametrize("mode", [None, 0o600, 0o444])
@pytest.mark.parametrize("name", ["é" * 120, "a" * 255])
def test_permissions_are_kept_or_those_of_any_new_file_also_under_the_longest_names(tmp_path, mode, name):
    path, plain = tmp_path / name, tmp_path / "plain"
    plain.write_text("older")
    if mode is not None:
        plain.chmod(mode)
        shutil.copy(plain, path)
    with atomic_write(path) as temporary:
        temporary.write_text("newer")
    assert path.read_text() == "newer"
    assert path.stat().st_mode == plain.stat().st_mode


def test_paths_that_cannot_be_written(tmp_path):
    """A folder without permission to write is tested with the whole command, in a namespace without privileges."""
    (tmp_path / "folder").mkdir()
    os.mkfifo(tmp_path / "pipe")  # like /dev/null, it must never be replaced by a file
    for name, what in {
        "none/a.nc": "there is no folder",
        "folder": "is not a regular file",
        "pipe": "is not a regular file",
        os.fsdecode(b"caf\xe9.nc"): "the name is no text in utf-8",
    }.items():
        with refused(what):
            check_output(tmp_path / name)
        with refused(what), atomic_write(tmp_path / name):
            pass
    assert sorted(os.listdir(tmp_path)) == ["folder", "pipe"]


def test_only_files_with_an_end_are_readable(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to(tmp_path / "pipe")
    (tmp_path / "file").write_text("")
    kinds = {tmp_path / "pipe": "a pipe", tmp_path / "link": "a pipe", tmp_path: "a folder", "/dev/zero": "a device"}
    for path, kind in kinds.items():
        with refused(rf"{path}: not readable \(it is {kind}\); a regular file is"):
            check_readable(path)
    for path in (tmp_path / "file", tmp_path / "none", "a\0b"):
        check_readable(path)
