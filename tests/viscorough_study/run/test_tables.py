"""Tables, and the first line that says how they were made."""

import os

import numpy as np
import pandas as pd
import pytest

from support.contract import refused
from support.workflow import load_script
from viscorough_study.run.tables import read_table, split_table, write_table

COLUMNS = {"source": ("origin of the curves", None), "beta": ("exponent", "1")}


def test_table_is_read_exactly(tmp_path):
    table = pd.DataFrame({"source": ["discs", "line ψ"], "beta": [0.1 + 0.2, np.nan], "realizations": [8, 50]})
    table["passed"] = [True, False]
    columns = {name: (f"{name} in words", "1") for name in table} | COLUMNS
    path = tmp_path / "fits.csv"
    write_table(table, path, columns=columns, title="Fits", trial=1)
    pd.testing.assert_frame_equal(read_table(path), table, check_exact=True)
    pd.testing.assert_frame_equal(pd.read_csv(path, skiprows=1), table, check_exact=True)  # as users read it
    header = split_table(path)[0]
    assert (header["title"], header["trial"]) == ("Fits", 1)
    assert header["columns"]["beta"] == {"long_name": "exponent", "units": "1"}
    del columns["beta"]
    with pytest.raises(ValueError, match="beta"):
        write_table(table, tmp_path / "b.csv", columns=columns, title="")
    assert os.listdir(tmp_path) == ["fits.csv"]


@pytest.fixture
def file(tmp_path):
    """Write a table of three rows."""
    table = pd.DataFrame({"source": ["discs", "lines", "discs"], "beta": [0.125, 0.25, 0.5]})
    write_table(table, tmp_path / "fits.csv", columns=COLUMNS, title="Fits")
    return tmp_path / "fits.csv"


CHANGES = {
    "a row less": lambda text: text[: text.rindex("discs")],
    "part of a number": lambda text: text.removesuffix("5\n"),
    "no newline": lambda text: text.removesuffix("\n"),
    "another number": lambda text: text.replace("0.25", "0.35"),
    "another title": lambda text: text.replace("Fits", "Bits"),
    "no first line": lambda text: text.split("\n", 1)[1],
    "half a first line": lambda text: text[:20],
    "nothing": lambda text: "",
}


@pytest.mark.parametrize("change", CHANGES)
def test_truncated_or_changed_table_is_refused(file, change):
    assert read_table(file)["beta"].tolist() == [0.125, 0.25, 0.5]
    file.write_text(CHANGES[change](file.read_text()))
    with refused(r"fits\.csv: not readable \(.*\); remove the file, so that the next run makes it again"):
        read_table(file)
    with refused(r"fits\.csv"):
        load_script("plot_exponent").main(file, "a.png")


def test_missing_texts_are_read_as_requested(tmp_path):
    table = pd.DataFrame({"source": ["", "NA"], "beta": [0.5, np.nan]})
    write_table(table, tmp_path / "fits.csv", columns=COLUMNS, title="Fits")
    assert read_table(tmp_path / "fits.csv")["source"].isna().tolist() == [True, True]
    texts = read_table(tmp_path / "fits.csv", keep_default_na=False, na_values=[""])
    assert texts["source"].tolist()[1] == "NA"
