"""Force histories and creep tables read from files: headers, units, and refusals."""

import numpy as np
import pytest

from support.contract import refused
from viscorough import read_load
from viscorough.io.medium_files import medium_from_mapping


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
    with refused(r"not readable|each larger than|finite"):
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


def test_units_of_creep_tables_are_converted(tmp_path):
    (tmp_path / "table.csv").write_text("t [ms],J [1/MPa]\n0,1\n500,3\n")
    table = medium_from_mapping({"kind": "creep_table", "file": "table.csv"}, "m", folder=tmp_path)
    np.testing.assert_allclose([table.times, table.compliances], [[0, 0.5], [1e-6, 3e-6]], rtol=1e-15)


@pytest.mark.parametrize("length_unit", ["m", "1"])
@pytest.mark.parametrize(
    "text",
    [
        *[f"{heading}\n0,1\n1,2\n" for heading in ("F [N],t [s]", "F mN,t ms", "t [Sek],F", "t,F [kp]", "t [],F")],
        *[f"{heading}\n0,1\n1,2\n" for heading in ("# time in ms", "# t [ms] F [mN]", "# t [ms],F [kp]", "t,F\nms,mN")],
        *[
            f"{heading}\n0,1\n1,2\n"
            for heading in ("force", "force,time", "F,t", "t,F,u", "t,t", "t,", "-,-", "−1,−2", "#DIV/0!,-1")
        ],
        *["0,1\n# in kN\n1,2\n", "#N/A,1\n1,2\n2,3\n", "0,1\n#NV,2\n2,3\n3,4\n"],
        *["t;F\n0;1\n1;2\n", "0,5;1,5\n1,5;2,5\n", "0,0,1,5\n1,0,2,5\n", "0,5 1,5\n1,0 2,5\n", "0\t1\n1\t2\n"],
        *['"0","1"\n"1","2"\n', "0,1\n1,\n2,3\n", "0,1\n1\n2,3\n", "0,1_0\n1,2_0\n", "", "time,force\n0,1\n"],
    ],
)
def test_ambiguous_tables_are_refused(history, text, length_unit):
    with refused(r"force\.csv: .*two columns, time and force"):
        history(text, length_unit)
