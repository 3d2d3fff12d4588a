"""Files of settings that cannot be read: one line with file and line."""

import os
import subprocess
import sys

import pytest

from viscorough_study.run.settings_files import main, read_settings_file

BROKEN = {
    "unclosed": (b"discs:\n  hurst: [0.4\n", "expected ',' or ']', but got '<stream end>'"),
    "not closed text": (b"seed: 'one\n", "line 2, column 1"),
    "key twice": (b"discs: {batch: 2}\nseed: 1\ndiscs: {elements: 9}\n", "key discs for the second time"),
    "UTF-16": ("seed: 1\n".encode("utf-16"), "'utf-8' codec can't decode byte 0xff in position 0"),
    "empty": (b"", "it holds no settings"),
    "tag": (b"seed: !!python/object:os.system 1\n", "could not determine a constructor"),
    "unhashable key": (b"? [discs]\n: 1\n", "found unhashable key"),
    "missing": (None, "No such file or directory"),
}


@pytest.mark.parametrize(("content", "message"), BROKEN.values(), ids=BROKEN)
def test_broken_file_is_one_line(tmp_path, monkeypatch, capsys, content, message):
    monkeypatch.chdir(tmp_path)
    if content is not None:
        (tmp_path / "mine.yaml").write_bytes(content)
    assert main(["mine.yaml"]) == 2
    output, text = capsys.readouterr()
    assert output == ""
    assert text.startswith("Error in the settings: mine.yaml: not readable (")
    assert message in text
    assert text.endswith("; a mapping of YAML in UTF-8 is needed\n")
    assert text.count("\n") == 1


def test_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    command = [sys.executable, "-m", "viscorough_study.run.settings_files", "pipe.yaml"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=3000, check=False)
    assert done.returncode == 2
    assert done.stderr == ("Error in the settings: pipe.yaml: not readable (it is a pipe); a regular file is needed\n")


def test_readable_file(tmp_path, capsys):
    path = tmp_path / "mine.yaml"
    path.write_bytes(b"\xef\xbb\xbfdiscs: {elements: 9}\nlines: {<<: {batch: 2}, batch: 3}\n")
    assert read_settings_file(path) == {"discs": {"elements": 9}, "lines": {"batch": 3}}
    assert main([path]) == 0
    assert capsys.readouterr() == ("", "")
