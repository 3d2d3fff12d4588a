"""Files are replaced when their content is complete, and not touched before."""

import errno
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from support.contract import refused
from support.faults import namespace
from viscorough.io.atomic import atomic_write, check_output, reading
from viscorough.io.heights import read_heights
from viscorough.io.saving import load_curve


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


WRITE_UNTIL_TOLD = """
import sys
from viscorough.io.atomic import atomic_write
with atomic_write(sys.argv[1]) as temporary:
    temporary.write_text(sys.argv[2])
    print(temporary, flush=True)
    sys.stdin.readline()
"""


def writing(path, text, *prefix):
    """Start a process that writes a file and waits before it is complete; return it and the temporary file."""
    command = [*prefix, sys.executable, "-c", WRITE_UNTIL_TOLD, str(path), text]
    writer = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    return writer, Path(writer.stdout.readline().strip())


def test_leftovers_of_killed_processes_are_removed(tmp_path):
    """The temporary file lies next to the target, so that replacing is atomic. A live process keeps its file."""
    for _ in range(2):
        writer, leftover = writing(tmp_path / "a.csv", "half")
        with writer:
            writer.kill()
        assert list(tmp_path.iterdir()) == [leftover], "the one of the last process only"
    _, place, _, _ = leftover.name.removeprefix(".a.csv").split(".", 3)
    running = tmp_path / f".a.csv.{place}.{os.getpid()}.1234abcd.part"
    running.write_text("of a process that is alive")
    (tmp_path / f".a.csv.{place}.{10**30}.1234abcd.part").write_text("of a number that no process has")
    write(tmp_path / "a.csv", "complete")
    assert sorted(path.name for path in tmp_path.iterdir() if str(10**30) not in path.name) == [running.name, "a.csv"]
    assert (tmp_path / "a.csv").read_text() == "complete"


def test_file_of_a_live_process_in_another_container_is_left_alone(tmp_path):
    """Process numbers differ between containers: the writer's number may be free here, or another process."""
    container = namespace("--user", "--map-root-user", "--pid", "--fork", "--mount-proc")
    writer, part = writing(tmp_path / "a.csv", "of the container", *container)
    with writer:
        assert int(part.name.split(".")[-3]) < 10, "the first processes of the container"
        write(tmp_path / "a.csv", "ours")
        assert part.exists()
        writer.communicate("go on\n", timeout=60)
    assert writer.returncode == 0
    assert (tmp_path / "a.csv").read_text() == "of the container"
    assert os.listdir(tmp_path) == ["a.csv"]


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


def test_only_regular_files_are_readable(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to(tmp_path / "pipe")
    (tmp_path / "file").write_text("")
    faults = {tmp_path / name: "it is a pipe" for name in ("pipe", "link")}
    faults |= {tmp_path: "it is a folder", "/dev/zero": "it is a device"}
    faults |= {tmp_path / "none": "No such file or directory", "a\0b": "embedded null byte"}
    for path, fault in faults.items():
        with refused(rf"{path}: not readable \({fault}\); text is needed"), reading(path, "text is needed"):
            pytest.fail("it was opened")
    with reading(tmp_path / "file", "text is needed"):
        pass


@pytest.mark.parametrize(
    ("name", "content", "what"),
    [
        ("a.npy", b"hello, this is text", r"\(it does not begin like a .npy file\)"),
        ("a.nc", b"hello", r"\(it is no NetCDF file\)"),
        ("a.nc", b"\x89HDF\r\n\x1a\n" + bytes(100), r"\(its structure is damaged\)"),
    ],
)
def test_messages_of_libraries_are_translated(tmp_path, name, content, what):
    (tmp_path / name).write_bytes(content)
    read = load_curve if name == "a.nc" else read_heights
    with refused(what):
        read(tmp_path / name, *([] if name == "a.nc" else [1.0]))


def test_long_messages_keep_their_end():
    with refused("not readable \\(aaa.* … .*; a remedy\\); a file is needed"), reading(__file__, "a file is needed"):
        raise ValueError(f"{'a' * 500}; a remedy")


def no_locks(*_):
    raise OSError(errno.ENOLCK, "No locks available")


def test_missing_file_locks_name_the_remedy(tmp_path, monkeypatch):
    """The NetCDF library reports them as an error of the structure of the file."""
    (tmp_path / "a.nc").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    monkeypatch.setattr("viscorough.io.atomic.fcntl.flock", no_locks)
    with refused("no file locks; the environment variable HDF5_USE_FILE_LOCKING=FALSE is needed"):
        read_heights(tmp_path / "a.nc", 1.0)
    with pytest.raises(OSError, match="HDF5_USE_FILE_LOCKING=FALSE"):
        write(tmp_path / "b.nc", "", RuntimeError("NetCDF: HDF error"))
