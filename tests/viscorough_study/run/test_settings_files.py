"""Files of settings that cannot be read: one line with file and line."""

import os
import subprocess
import sys

import pytest

from viscorough_study.run.settings import SettingsError
from viscorough_study.run.settings_files import main, read_settings_file

BROKEN = {
    "unclosed": (b"discs:\n  hurst: [0.4\n", "mine.yaml, line 3, column 1: expected ',' or ']'"),
    "not closed text": (b"seed: 'one\n", "mine.yaml, line 2, column 1: found unexpected end of stream"),
    "key twice": (b"discs: {batch: 2}\nseed: 1\ndiscs: {elements: 9}\n", "mine.yaml, line 3, column 1: key discs for"),
    "UTF-16": ("seed: 1\n".encode("utf-16"), "mine.yaml: byte 1 is not UTF-8 text; allowed: YAML in UTF-8"),
    "empty": (b"", "mine.yaml: holds no settings"),
    "tag": (b"seed: !!python/object:os.system 1\n", "mine.yaml, line 1, column 7: could not determine a constructor"),
    "unhashable key": (b"? [discs]\n: 1\n", "mine.yaml, line 1, column 3: found unhashable key"),
}


@pytest.mark.parametrize(("content", "message"), BROKEN.values(), ids=BROKEN)
def test_broken_file_is_one_line(tmp_path, monkeypatch, capsys, content, message):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.yaml").write_bytes(content)
    with pytest.raises(SettingsError) as error:
        read_settings_file("mine.yaml")
    assert str(error.value).startswith(message)
    assert main(["mine.yaml"]) == 2
    assert capsys.readouterr() == ("", f"Error in the settings: {error.value}\n")


def test_missing_file():
    with pytest.raises(SettingsError, match=r"^nowhere.yaml: not readable \(No such file or directory\)$"):
        read_settings_file("nowhere.yaml")


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
