"""Files that cannot be read are refused in one line."""

import os

import pytest

from support.contract import refused
from viscorough.io.heights import read_heights
from viscorough.io.refusals import reading
from viscorough.io.saving import load_curve


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
