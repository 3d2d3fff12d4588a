"""Files of settings that cannot be read: one line with file and line."""

import pytest

from viscorough_study.run.settings_files import check_command_line, read_settings_file

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
def test_broken_file_is_reported_in_one_line(tmp_path, monkeypatch, capsys, content, message):
    monkeypatch.chdir(tmp_path)
    if content is not None:
        (tmp_path / "mine.yaml").write_bytes(content)
    with pytest.raises(SystemExit, match="2"):
        check_command_line(["--configfile", "mine.yaml"])
    output, text = capsys.readouterr()
    assert output == ""
    assert text.startswith("Error in the settings: mine.yaml: not readable (")
    assert message in text
    assert text.endswith("; a mapping of YAML in UTF-8 is needed\n")
    assert text.count("\n") == 1


def test_valid_file_is_read(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_bytes(b"\xef\xbb\xbfdiscs: {elements: 9}\nlines: {<<: {batch: 2}, batch: 3}\n")
    assert read_settings_file(path) == {"discs": {"elements": 9}, "lines": {"batch": 3}}


def test_files_of_settings_are_found_on_a_command_line(tmp_path, monkeypatch, capsys):
    """Values of other options, and targets, are not files of settings."""
    monkeypatch.chdir(tmp_path)
    for name in ("a.yaml", "b.yaml"):
        (tmp_path / name).write_text("seed: 1\n")
    check_command_line(["--cores", "2", "--configfile", "a.yaml", "b.yaml", "--directory", "x", "--", "all"])
    check_command_line(["all", "--cores=2", "--configfile=b.yaml", "y"])
    for options in (
        ["--configfile", "a.yaml", "c.yaml"],
        ["--configfiles=c.yaml", "-n"],
        ["-n", "--configfiles", "c.yaml"],
    ):
        with pytest.raises(SystemExit, match="2"):
            check_command_line(options)
        assert capsys.readouterr().err.startswith("Error in the settings: c.yaml: not readable (No such file")
