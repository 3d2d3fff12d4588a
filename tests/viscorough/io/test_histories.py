"""Force histories read from files: headers, units, and refusals."""

import numpy as np
import pytest

from support.contract import refused
from viscorough import AccuracyWarning, read_load


@pytest.fixture
def history(tmp_path):
    """Read times and forces of a history from a text."""

    def read(text, length_unit="1"):
        (tmp_path / "force.csv").write_text(text, encoding="utf-8")
        load = read_load(tmp_path / "force.csv", length_unit=length_unit)
        return load.time, load.values

    return read


@pytest.mark.parametrize("header", ["", "t [s],F [N]\n", "# a comment\n", "\n\nTime;seconds,Force\n", "\ufefft,F\n"])
def test_header_is_a_row_without_numbers(history, header):
    np.testing.assert_array_equal(history(f"{header}0,1e0\n\n1,2\n", "m"), [[0, 1], [1, 2]])


@pytest.mark.parametrize("first", ["0,nan", "inf,1", "-Infinity,x", "0,one", "zero,1", "-.5s,-1N", "+1 s,F"])
def test_first_row_with_a_number_is_no_header(history, first):
    """As a header it would be dropped, and with it the start of the history."""
    with refused(r"is no row of numbers|does not name the columns|finite"):
        history(f"{first}\n1,2\n2,3\n")


@pytest.mark.parametrize(
    "heading",
    [
        *["t [ms],F [mN]", "t / ms , F / mN", "Zeit in ms,Kraft in mN", "t_ms,F_mN", '"t [ms]","F [mN]"', "ms,mN"],
        *["t [1e-3 s],F [1e-3 N]", "# of the second run\n# t [ms], F [mN]", "\ufefft (ms),Load in z (mN)"],
        "# 2013/11/12, run (5)\ntime(milliseconds),force(mN)",
    ],
)
def test_units_in_a_heading_are_converted(history, heading):
    times, force = history(f"{heading}\n0,1\n1,2\n3,2.5\n", "um")
    np.testing.assert_allclose([times, force], [[0, 1e-3, 3e-3], [1e-3, 2e-3, 2.5e-3]], rtol=1e-15)
    with refused("states a unit, but the unit of length is not known"):
        history(f"{heading}\n0,1\n1,2\n")


@pytest.mark.parametrize(
    ("heading", "factors"),
    [
        ("t [min],F", (60, 1)),
        ("t,F (kN)", (1, 1e3)),
        ("t [µs],F [μN]", (1e-6, 1e-6)),
        *[(plain, (1, 1)) for plain in ("t_s,F_N", "time t,contact force F", "# a,b\n# c\nt,F", "# 5 N, 2 s")],
    ],
)
def test_each_column_has_its_own_unit_or_none(history, heading, factors):
    times, force = history(f"{heading}\n0,1\n1,2\n", "m")
    np.testing.assert_allclose([times[1], force[0]], factors, rtol=1e-3)


TABLES = [
    "F,t\n1,0\n3,2\n",
    "force;time\n1,0;0,0\n3,0;2,0\n",
    "Time\tForce\n0\t1\n2\t3\n",
    "0,0;1,0\n2,0;3,0\n",
    "0,0 1,0\n2,0 3,0\n",
    '"0","1"\n"2","3"\n',
    "0\t1\n2\t3\n",
    "n,Depth,Force,Time\n0,7,1,0\n1,8,3,2\n",
    "Zeit;Kraft;Kommentar\n0;1;Anfang\n2;3;\n",
    "t (s)  Load On Sample (N)  Piezo (nm)\n0 1 5\n2 3 6\n",
    "# index,time,force rate (N/s),force\n0,0,9,1\n1,2,9,3\n",
    "Sample: 5\nTime,Load\nsec,mN\n0,1000\n2,3000\n# the end\n",
    "Zeit seit Start,Prüfkraft,Weg\n[s],[mN],[µm]\n0,1000,4\n2,3000,5\n",
    "d_nm,F_uN,t_ms\n4,1e6,0\n5,3e6,2000\n",
    '"Test Time, s","Indent Load, mN"\n0,1000\n2,3000\n',
    "P (N),h (nm),t (s)\n1,5,0\n3,6,2\n",
    "s,N\n0,1\n2,3\n",
]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "cp1252"])
@pytest.mark.parametrize("text", TABLES)
def test_heading_decides_which_columns_are_read(tmp_path, text, encoding):
    (tmp_path / "record.txt").write_text(text, encoding=encoding)
    load = read_load(tmp_path / "record.txt", length_unit="um")
    np.testing.assert_allclose([load.time, load.force], [[0, 2], [1, 3]])


OF_ANOTHER_QUANTITY = [
    "time,depth\n0,0\n1,1e-9\n",
    "Time [s],Displacement [nm]\n0,0\n1,1e-9\n",
    "t,F [nm]\n0,0\n1,1\n",
    "t,force error\n0,0\n1,1\n",
    "t,Force (V)\n0,0\n1,1\n",
    "t,Force rate (N/s)\n0,0\n1,1\n",
    "Displacement,Force\n0,0\n1,1\n",
    "t,signal\n0,0\n1,1\n",
    "t,Force,Load\n0,0,1\n1,1,2\n",
    "t,t,F\n0,0,1\n1,1,2\n",
]


@pytest.mark.parametrize("text", OF_ANOTHER_QUANTITY)
def test_heading_of_another_quantity_is_refused(history, text):
    with refused(r"force\.csv: .*columns states it, as in (force|time)=NAME or"):
        history(text, "um")


@pytest.mark.parametrize("heading", ["Height (measured & smoothed) [m]", "Z (nm)", "Piezo_um", "tip position/m"])
def test_other_lengths_are_no_depths(tmp_path, heading):
    """The piezo of an AFM moves by the depth and the deflection of the cantilever."""
    (tmp_path / "a.csv").write_text(f"t [s];{heading};F [N]\n0;0;0\n1;1;2\n")
    with refused("the heading names no depth"):
        read_load(tmp_path / "a.csv", "depth", "um")
    assert read_load(tmp_path / "a.csv", "force", "um").force.tolist() == [0, 2]


def test_columns_are_chosen_by_name_or_number(tmp_path):
    (tmp_path / "a.csv").write_text("5,0,1\n6,2,3\n")
    (tmp_path / "b.csv").write_text("Piezo [nm],Clock [ms],Force (retract) [mN],Force [N]\n5,0,1,9\n6,2,3,9\n")
    np.save(tmp_path / "c.npy", [[5, 0, 1], [6, 2, 3]])
    for name in ("a.csv", "c.npy"):
        load = read_load(tmp_path / name, "force", "m", {"time": 2, "force": "3 [mN]"})
        np.testing.assert_allclose([load.time, load.force], [[0, 2], [1e-3, 3e-3]])
    load = read_load(tmp_path / "b.csv", "force", "m", {"time": "clock", "force": "Force (retract) [mN]"})
    np.testing.assert_allclose([load.time, load.force], [[0, 2e-3], [1e-3, 3e-3]])
    for columns, what in (
        ({"time": 0, "force": 1}, "counted from 1"),
        ({"time": 1, "force": 4}, "the file has 3 columns"),
        ({"time": 1, "force": 1}, "one column for time and force"),
        ({"time": 1, "force": "F"}, "no column has this name"),
        ({"time": 1, "compression": 2}, "'compression'; allowed: time, force"),
    ):
        with refused(what):
            read_load(tmp_path / "a.csv", "force", "m", columns)
    (tmp_path / "d.csv").write_text("time,depth\n0,1\n2,3\n")
    with refused("the heading names depth there"):
        read_load(tmp_path / "d.csv", "force", "m", {"time": 1, "force": 2})
    with refused("2 \\[s\\] contradicts the heading 'Clock \\[ms\\]'"):
        read_load(tmp_path / "b.csv", "force", "m", {"time": "2 [s]", "force": 3})


def test_small_negative_forces_are_noise_before_contact(tmp_path):
    (tmp_path / "a.csv").write_text("t,F\n0,-1e-12\n1,0\n2,1e-9\n")
    with pytest.warns(AccuracyWarning, match="1 forces below 0, down to -1e-12, count as noise and are set to 0"):
        load = read_load(tmp_path / "a.csv")
    assert load.force.tolist() == [0, 0, 1e-9]
    (tmp_path / "a.csv").write_text("t,F\n0,-1e-10\n1,0\n2,1e-9\n")
    with refused("sample 0 is -1e-10"):
        read_load(tmp_path / "a.csv")


AMBIGUOUS = [
    *[f"{heading}\n0,1\n1,2\n" for heading in ("F mN,t kg", "t [Sek],F", "t,F [kp]", "t [],F", "force", "t,F,u")],
    *[f"{heading}\n0,1\n1,2\n" for heading in ("# time in ms", "# t [ms] F [mN]", "# t [ms],F [kp]", "t,", "-,-")],
    *[f"{heading}\n0,1\n1,2\n" for heading in ("#DIV/0!,-1", "a,b", "# Units: ms, mN\nt,F", "t,F\n[Data]")],
    *["0,1\n# in kN\n1,2\n", "#N/A,1\n1,2\n2,3\n", "0,1\n#NV,2\n2,3\n3,4\n", "0,0,1,5\n1,0,2,5\n"],
    *["0,1\n1,\n2,3\n", "0,1\n1\n2,3\n", "0,1_0\n1,2_0\n", "", "time,force\n0,1\n", "t;F\n0;1,234.5\n1;2\n"],
    *["0,1,2\n1,2,3\n", "t,F\n0,1\nt,F\n1,2\n", "t,F\n0,1\n1,nan\n", "t,F\n00:01,1\n00:02,2\n"],
]


@pytest.mark.parametrize("length_unit", ["m", "1"])
@pytest.mark.parametrize("text", AMBIGUOUS)
def test_ambiguous_tables_are_refused(history, text, length_unit):
    with refused(r"force\.csv: .*(two columns, time and force|is needed|states it|the columns are not)"):
        history(text, length_unit)
