"""Files of settings that cannot be read: one line with file and line."""

import re

import pytest

from viscorough_study.run.settings_files import read_settings_file

BROKEN = {
    "unclosed": (b"discs:\n  hurst: [0.4\n", "expected ',' or ']', but got '<stream end>'"),
    "not closed text": (b"seed: 'one\n", "line 2, column 1"),
    "key twice": (b"discs: {batch: 2}\nseed: 1\ndiscs: {elements: 9}\n", "key discs for the second time"),
    "UTF-16": ("seed: 1\n".encode("utf-16"), "'utf-8' codec can't decode byte 0xff in position 0"),
    "octal": (b"seed: 0123\n", "0123 begins with a zero, which makes it octal; write it without the zero"),
    "empty": (b"", "it holds no settings"),
    "tag": (b"seed: !!python/object:os.system 1\n", "could not determine a constructor"),
    "unhashable key": (b"? [discs]\n: 1\n", "found unhashable key"),
    "missing": (None, "No such file or directory"),
}


@pytest.mark.parametrize(("content", "message"), BROKEN.values(), ids=BROKEN)
def test_broken_file_is_reported_in_one_line(tmp_path, monkeypatch, content, message):
    monkeypatch.chdir(tmp_path)
    if content is not None:
        (tmp_path / "mine.yaml").write_bytes(content)
    with pytest.raises(ValueError, match=re.escape(message)) as error:
        read_settings_file("mine.yaml")
    assert re.fullmatch(r"mine.yaml: not readable \(.*\); a mapping of YAML in UTF-8 is needed", str(error.value))


def test_valid_file_is_read(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_bytes(b"\xef\xbb\xbfdiscs: {elements: 9}\nlines: {<<: {batch: 2}, batch: 3}\n")
    assert read_settings_file(path) == {"discs": {"elements": 9}, "lines": {"batch": 3}}
