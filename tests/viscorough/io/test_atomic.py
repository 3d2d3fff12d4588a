"""Files are replaced when their content is complete, and not touched otherwise."""

import os
import platform
import subprocess
import sys
import textwrap

import pytest

from support.curves import one_line
from viscorough.io.atomic import atomic_write, check_output


def test_permissions_are_those_of_any_new_file(tmp_path):
    with atomic_write(tmp_path / "new") as temporary:
        temporary.write_text("")
    (tmp_path / "plain").write_text("")
    assert (tmp_path / "new").stat().st_mode == (tmp_path / "plain").stat().st_mode


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


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, MemoryError, TypeError])
def test_interrupted_writing_leaves_the_older_file(tmp_path, interruption):
    path = tmp_path / "curve"
    path.write_text("older")
    with pytest.raises(interruption):
        write_half(path, interruption())
    assert path.read_text() == "older"
    assert os.listdir(tmp_path) == ["curve"]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), RuntimeError("NetCDF: HDF error")])
def test_failed_writing_is_one_line(tmp_path, error):
    with pytest.raises(OSError, match=r"a\.csv: not written") as raised:
        write_half(tmp_path / "a.csv", error)
    one_line(raised)
    assert os.listdir(tmp_path) == []


def test_leftovers_of_killed_processes_are_removed(tmp_path):
    """The temporary file lies beside the target, else replacing would not be atomic; that of a live process stays."""
    script = textwrap.dedent("""
        import os, signal, sys
        from viscorough.io.atomic import atomic_write
        with atomic_write(sys.argv[1]) as temporary:
            temporary.write_text("half")
            print(temporary, flush=True)
            os.kill(os.getpid(), signal.SIGKILL)
    """)
    for _ in range(2):
        command = [sys.executable, "-c", script, str(tmp_path / "a.csv")]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert os.listdir(tmp_path) == [os.path.basename(done.stdout.strip())], "the one of the last process only"
    running = tmp_path / f".a.csv.{platform.node()}.{os.getpid()}.1234abcd.part"
    running.write_text("of a process that is alive")
    with atomic_write(tmp_path / "a.csv") as temporary:
        temporary.write_text("complete")
    assert sorted(path.name for path in tmp_path.iterdir()) == [running.name, "a.csv"]
    assert (tmp_path / "a.csv").read_text() == "complete"


def test_paths_that_cannot_be_written(tmp_path):
    """A folder without permission to write is tested with the whole command, in a namespace without privileges."""
    (tmp_path / "folder").mkdir()
    os.mkfifo(tmp_path / "pipe")  # like /dev/null, it must never be replaced by a file
    for path in (tmp_path / "none" / "a.nc", tmp_path / "folder", tmp_path / "pipe"):
        with pytest.raises(ValueError, match=str(path)) as error:
            check_output(path)
        one_line(error)
        with pytest.raises(ValueError, match=str(path)), atomic_write(path):
            pass
    assert sorted(os.listdir(tmp_path)) == ["folder", "pipe"]
