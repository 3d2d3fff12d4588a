"""Files of measured surfaces named by the settings."""

import pytest

from viscorough_study.run.scans import scans

OTHER = {"name": "other", "files": ["scans/b.npy"], "spacing": [2.0], "unit": "nm"}
CURVES = {"measured_tolerance": 1e-3, "until_x": 2.0}


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scans").mkdir()
    for name in ("a 1.gwy", "b.gwy", "b.npy", "{A}.npy", "text.txt"):
        (tmp_path / "scans" / name).write_text(name if name.endswith(".txt") else f"\0{name}")
    return tmp_path


def test_settings_name_scans_by_files_and_patterns(here):
    entries = [{"name": "ground", "files": ["scans/*.gwy"], "unit": "um"}, OTHER]
    by_name = scans(entries, CURVES)
    assert list(by_name) == ["ground_a_1", "ground_b", "other_b"]
    assert by_name["ground_a_1"]["file"] == "scans/a 1.gwy"
    assert (by_name["ground_b"]["unit"], by_name["other_b"]["unit"], by_name["ground_b"]["spacing"]) == ("um", "nm", [])
    assert by_name["ground_b"]["bytes"] == 6
    assert by_name["ground_b"]["indentation"] == {"tolerance": 1e-3, "until_x": 2.0}
    (absolute,) = scans([{"name": "ground", "files": [str(here / "scans/b.gwy")]}], CURVES).values()
    assert absolute["digest"] == by_name["ground_b"]["digest"]
    (here / "scans/b.gwy").write_text("\0b.gwz")
    (changed,) = scans([{"name": "ground", "files": ["scans/b.gwy"]}], CURVES).values()
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


@pytest.mark.parametrize("file", ["b.npy", "text.txt"])
@pytest.mark.usefixtures("here")
def test_matrices_without_spacing_or_unit_are_refused(file):
    entry = {"name": "ground", "files": [f"scans/{file}"]}
    with pytest.raises(ValueError, match=rf"{file} is a matrix of numbers; measured.spacing and measured.unit must be"):
        scans([entry], CURVES)
    with pytest.raises(ValueError, match=r"numbers; measured.unit must be set"):
        scans([entry | {"spacing": [1.0]}], CURVES)
