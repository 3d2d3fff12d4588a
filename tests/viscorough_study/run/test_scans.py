"""Files of measured surfaces named by the settings."""

import pytest

from viscorough_study.run.scans import scans

CURVES = {"measured_tolerance": 1e-3, "until_x": 2.0}


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scans").mkdir()
    for name in ("a 1.txt", "b.txt", "b.npy", "{A}.npy"):
        (tmp_path / "scans" / name).write_text(name)
    return tmp_path


def test_settings_name_scans_by_files_and_patterns(here):
    entries = [{"name": "ground", "files": ["scans/*.txt"], "unit": "um"}, {"name": "other", "files": ["scans/b.npy"]}]
    by_name = scans(entries, CURVES)
    assert list(by_name) == ["ground_a_1", "ground_b", "other_b"]
    assert by_name["ground_a_1"]["file"] == "scans/a 1.txt"
    assert (by_name["ground_b"]["unit"], by_name["other_b"]["unit"], by_name["other_b"]["spacing"]) == ("um", None, [])
    assert by_name["ground_b"]["bytes"] == 5
    assert by_name["ground_b"]["indentation"] == {"tolerance": 1e-3, "until_x": 2.0}
    (absolute,) = scans([{"name": "ground", "files": [str(here / "scans/b.txt")]}], CURVES).values()
    assert absolute["digest"] == by_name["ground_b"]["digest"]
    (here / "scans/b.txt").write_text("b.txu")
    (changed,) = scans([{"name": "ground", "files": ["scans/b.txt"]}], CURVES).values()
    assert changed["digest"] != absolute["digest"]


@pytest.mark.parametrize(
    ("files", "message"),
    [
        ("scans/c*.txt", r"measured, ground: there is no file scans/c\*.txt in /"),
        ("scans", "no file"),
        ("scans/b.*", "have the same name"),
        ("scans/?A?.npy", r"scans/{A}.npy has a brace in its name; rename the file"),
    ],
)
@pytest.mark.usefixtures("here")
def test_missing_and_ambiguous_files_are_refused(files, message):
    with pytest.raises(ValueError, match=message):
        scans([{"name": "ground", "files": [files]}], CURVES)
