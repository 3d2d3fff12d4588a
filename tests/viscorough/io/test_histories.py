"""Histories are read from two named columns; every file in which the columns are not certain is refused."""

import numpy as np
import pytest

from support.contract import refused
from viscorough import AccuracyWarning, read_load


@pytest.fixture
def history(tmp_path):
    """Read times and forces of a history from a text."""

    def read(text, length_unit="um", columns=None, encoding="utf-8"):
        (tmp_path / "force.csv").write_text(text, encoding=encoding)
        load = read_load(tmp_path / "force.csv", length_unit=length_unit, columns=columns)
        return [load.time.tolist(), load.values.tolist()]

    return read


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
@pytest.mark.parametrize(
    "text",
    [
        "time (s),force (N)\n0,1\n2,3\n",
        "force (mN),time (ms)\n1e3,0\n3e3,2000\n",
        "Time(s) ; Force (kN)\n0;0.001\n2;.003\n",
        '"time (s)"\t"force (N)"\n"0"\t"1"\n"2"\t"3"\n',
        "# Prüfling A, 5 N\n\ntime (min),force (µN)\n0,1e6\n0.03333333333333333,3e6\n# end\n",
        "n,depth (um),force (N),time (s),note\n0,7,1,0,first\n1,,3,2,\n",
        "T°C,force rate (N/s),time (s),force (N)\n20,9,0,1\n21,9,2,3\n",
    ],
)
def test_named_columns_are_read_in_any_order_and_unit(history, text, encoding):
    np.testing.assert_allclose(history(text, encoding=encoding), [[0, 2], [1, 3]], rtol=1e-14)


def test_depths_are_in_metres(tmp_path):
    (tmp_path / "a.csv").write_text("time (s),depth (nm)\n0,0\n1,500\n")
    assert read_load(tmp_path / "a.csv", "depth").depth.tolist() == [0, pytest.approx(5e-7, rel=1e-14)]
    (tmp_path / "a.csv").write_text("0,0\n1,500\n")
    columns = {"time": 1, "depth": 2}
    for unit, expected in (("nm", 5e-7), ("1", 500.0)):
        assert read_load(tmp_path / "a.csv", "depth", unit, columns).depth.tolist() == [0, pytest.approx(expected)]


def test_without_a_unit_of_length_headings_have_no_units(history):
    assert history("force,time\n1,0\n3,2\n", "1") == [[0, 2], [1, 3]]
    with refused("heading 'time \\(s\\)': the unit of length of the indenter is not known, so that no heading may"):
        history("time (s),force (N)\n0,1\n2,3\n", "1")
    with refused("heading 'time': the unit of length of the indenter is um, so that each needs one"):
        history("time,force\n0,1\n2,3\n", "um")


@pytest.mark.parametrize(
    ("heading", "what"),
    [
        *[(text, "no column is named time") for text in ("T°C,elapsed [s],F [N]", "t (s),F (N)", "time [s],force [N]")],
        *[(text, "no column is named time") for text in ("0,1", "Zeit (s),Kraft (N)", "time s,force (N)", "a,b")],
        *[
            (text, "no column is named force")
            for text in ("time (s),depth (nm)", "time (s),force/N", "time (s),load (N)")
        ],
        ("time (s),time (ms),force (N)", "more than one column is named time"),
        ("time (s),force (N),Force (mN)", "more than one column is named force"),
        ("time (nm),force (N)", "unit 'nm': cannot be converted to s"),
        ("time (s),force (V)", "unit 'V': cannot be converted to N"),
        ("time (s),force (foo)", "unit 'foo': a unit such as"),
        ("time (s);force (N),note", "';' and ',' in one row; one delimiter"),
        ("time (s) force (N)", "heading .time.: the unit of length of the indenter is um, so that each needs one"),
    ],
)
def test_other_headings_are_refused(history, heading, what):
    cells = heading.count(",") + 1
    with refused(rf"force\.csv: .*{what}"):
        history("\n".join([heading, *(",".join(map(str, range(row, row + cells))) for row in range(3))]))


@pytest.mark.parametrize(
    ("row", "what"),
    [
        ("1", "line 3 has 1 cells, line 1 has 2; rows of one length are needed"),
        ("1,2,3", "line 3 has 3 cells, line 1 has 2"),
        ("1,", "line 3 has an empty cell"),
        ("1,1_0", "line 3 has '1_0', which is no number"),
        ("1,one", "line 3 has 'one', which is no number"),
        ("1,inf", "line 3 has 'inf', which is no number"),
        ("00:01,2", "line 3 has '00:01', which is no number"),
        ('1,"2,5"', "line 3 has '2,5', which is no number; one delimiter, and points as decimal marks"),
        ("1,nan", "nan|finite"),
        ("time (s),force (N)", r"line 3 has 'time \(s\)', which is no number"),
    ],
)
def test_faulty_rows_are_refused(history, row, what):
    with refused(rf"force\.csv: .*{what}"):
        history(f"time (s),force (N)\n0,1\n{row}\n2,3\n")


def test_columns_of_a_file_without_headings_are_chosen_by_number(history):
    for text in ("5,0,1\n6,2,3\n", "# comment\n5 0 1\n6 2 3\n", "5\t0\t1\n6\t2\t3\n"):
        assert history(text, columns={"time": 2, "force": 3}) == [[0, 2], [1, 3]]
    for columns, what in (
        ({"time": 0, "force": 1}, "columns time: must be a whole number of at least 1"),
        ({"time": 1, "force": 4}, "columns 4: line 1 has 3 columns"),
        ({"time": 1, "force": 1}, "time and force are in the same column"),
        ({"time": 1, "force": "2"}, "columns force: must be a whole number"),
        ({"time": 1}, "the numbers of the columns of time and force are needed"),
        ({"time": 1, "compression": 2}, "the numbers of the columns of time and force are needed"),
    ):
        with refused(what):
            history("5,0,1\n6,2,3\n", columns=columns)
    with refused("its commas may be decimal marks"):
        history("0,5,1,968\n1,5,2,75\n", columns={"time": 1, "force": 3})
    with refused(r"line 1 is a heading, with argument columns; name its columns time \(s\) and force \(N\), or remove"):
        history("T°C,elapsed [s],F [N]\n20,0,1\n21,2,3\n", columns={"time": 2, "force": 3})


@pytest.mark.parametrize(
    ("content", "what"),
    [
        (b"", "it has no rows"),
        (b"time (s),force (N)\n", r"it has no rows; the columns time \(s\) and force \(N\) are needed"),
        (b"\x93NUMPY\x01\x00", "it is no text"),
    ],
)
def test_files_without_rows_are_refused(tmp_path, content, what):
    (tmp_path / "a.csv").write_bytes(content)
    with refused(what):
        read_load(tmp_path / "a.csv")
    with refused("missing.csv: not readable"):
        read_load(tmp_path / "missing.csv")


def test_small_negative_forces_are_noise_before_contact(tmp_path):
    (tmp_path / "a.csv").write_text("time (s),force (N)\n0,-1e-12\n1,0\n2,1e-9\n")
    with pytest.warns(AccuracyWarning, match="1 forces below 0, down to -1e-12, count as noise and are set to 0"):
        load = read_load(tmp_path / "a.csv")
    assert load.force.tolist() == [0, 0, 1e-9]
    (tmp_path / "a.csv").write_text("time (s),force (N)\n0,-1e-10\n1,0\n2,1e-9\n")
    with refused("sample 0 is -1e-10"):
        read_load(tmp_path / "a.csv")
