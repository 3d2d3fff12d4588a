"""Force histories read from files: what is a header, and what is a mistake."""

import numpy as np
import pytest

from support.curves import one_line
from viscorough.io.motion import read_force_history
from viscorough.viscous.correspondence import impulses


@pytest.mark.parametrize(
    "header",
    ["", "time,force\n", "t [s],F [N]\n", "# a comment\n", "\n\nTime;seconds,Force\n", "\ufefft,F\n", "\ufeff"],
)
def test_a_header_is_a_row_without_numbers(tmp_path, header):
    (tmp_path / "force.csv").write_text(f"{header}0,1e0\n\n1,2\n", encoding="utf-8")
    times, force = read_force_history(tmp_path / "force.csv", "m")
    np.testing.assert_array_equal([times, force], [[0, 1], [1, 2]])


@pytest.mark.parametrize("first", ["0,nan", "inf,1", "-Infinity,x", "0,one", "zero,1", "0s,1N", "-.5s,-1N", "+1 s,F"])
def test_a_first_row_with_a_number_is_no_header(tmp_path, first):
    """It would vanish, and with it the beginning of the history."""
    (tmp_path / "force.csv").write_text(f"{first}\n1,2\n2,3\n")
    with pytest.raises(ValueError, match=r"not readable|each larger than|finite") as error:
        impulses(*read_force_history(tmp_path / "force.csv")[::-1])
    one_line(error)


@pytest.mark.parametrize(
    "heading",
    [
        *["t [ms],F [mN]", "t (ms),F (mN)", "t / ms , F / mN", "t/ms,F/mN", "Zeit in ms,Kraft in mN", "t_ms,F_mN"],
        *[
            '"t [ms]","F [mN]"',
            "# t [ms],F [mN]",
            "#t (ms), F (mN)",
            "ms,mN",
            "time ms,force mN",
            "t [1e-3 s],F [1e-3 N]",
        ],
        *["# of the second run\n# t [ms], F [mN]", "time(milliseconds),force(mN)", "\ufefft (ms),Load in z (mN)"],
        "# 2013/11/12, run (5)\nt (ms),F (mN)",
    ],
)
def test_units_in_a_heading_are_converted(tmp_path, heading):
    (tmp_path / "force.csv").write_text(f"{heading}\n0,1\n1,2\n3,2.5\n", encoding="utf-8")
    times, force = read_force_history(tmp_path / "force.csv", "um")
    np.testing.assert_allclose([times, force], [[0, 1e-3, 3e-3], [1e-3, 2e-3, 2.5e-3]], rtol=1e-15)
    with pytest.raises(ValueError, match="states a unit, but the unit of length is not known") as error:
        read_force_history(tmp_path / "force.csv")
    one_line(error)


@pytest.mark.parametrize(
    ("heading", "factors"),
    [
        *[
            ("t [min],F", (60, 1)),
            ("t,F (kN)", (1, 1e3)),
            ("t [µs],F [μN]", (1e-6, 1e-6)),
            ("t (h),F [lbf]", (3600, 4.448)),
        ],
        *[("s,N", (1, 1)), ("t_s,F_N", (1, 1)), ("time t,contact force F", (1, 1)), ("Zeit,Kraft", (1, 1))],
        *[("# a,b\n# c\nt,F", (1, 1)), ("# by X (Y)\n# 2013/11/12, run A/B", (1, 1)), ("# 5 N, 2 s", (1, 1))],
    ],
)
def test_each_column_has_its_own_unit_or_none(tmp_path, heading, factors):
    (tmp_path / "force.csv").write_text(f"{heading}\n0,1\n1,2\n", encoding="utf-8")
    times, force = read_force_history(tmp_path / "force.csv", "m")
    np.testing.assert_allclose([times[1], force[0]], factors, rtol=1e-3)


@pytest.mark.parametrize("length_unit", ["m", "1"])
@pytest.mark.parametrize(
    "content",
    [
        *[f"{heading}\n0,1\n1,2\n" for heading in ("F [N],t [s]", "F/N,t/s", "F mN,t ms", "N,s", "F [N],t")],
        *[
            f"{heading}\n0,1\n1,2\n"
            for heading in ("t [Sek],F", "t,F [kp]", "t,F (normal)", "t [],F", "t [m],F", "t,F/G")
        ],
        *[f"{heading}\n0,1\n1,2\n" for heading in ("# time in ms", "# t: ms", "# t [ms] F [mN]", "# units (kN)")],
        *[f"{heading}\n0,1\n1,2\n" for heading in ("force", "t,F,u", "time force", "t,t", "t,", "-,-", "?,x", "−1,−2")],
        *["t,F\nms,mN\n0,1\n1,2\n", "0,1\n# in kN\n1,2\n", "# t [ms],F [kp]\n0,1\n1,2\n"],
        *["#N/A,1\n1,2\n2,3\n", "0,1\n#NV,2\n2,3\n3,4\n", "#DIV/0!,-1\n0,1\n1,2\n", "N/A,N/A\n0,1\n1,2\n"],
        *["0;1\n1;2\n", "t;F\n0;1\n1;2\n", "0;1,5\n1;2,5\n", "0,5;1,5\n1,5;2,5\n", "t;F\n0,5;1,5\n1,5;2,5\n"],
        *["0,0,1,5\n1,0,2,5\n", "0,5\t1,5\n1,0\t2,5\n", "0,5 1,5\n1,0 2,5\n", "Kraft\n0,5\n1,5\n", "0\t1\n1\t2\n"],
        *['"0","1"\n"1","2"\n', "0,1\n1,\n2,3\n", "0,1\n,2\n2,3\n", "0,1\n1\n2,3\n", "0,1_0\n1,2_0\n"],
    ],
)
def test_what_is_not_certain_is_refused(tmp_path, content, length_unit):
    (tmp_path / "force.csv").write_text(content, encoding="utf-8")
    with pytest.raises(ValueError, match=r"force\.csv: .*two columns, time and force") as error:
        read_force_history(tmp_path / "force.csv", length_unit)
    one_line(error)


@pytest.mark.parametrize("content", ["", "time,force\n", "time,force\n0,1\n", "a,b\nc,d\n", "0,1\n1\n", "0 1\n1 2\n"])
def test_files_without_two_rows_of_two_numbers_are_refused(tmp_path, content):
    (tmp_path / "force.csv").write_text(content)
    with pytest.raises(ValueError, match=r"force.csv: .*two columns, time and force") as error:
        read_force_history(tmp_path / "force.csv")
    one_line(error)
