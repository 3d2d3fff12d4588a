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
    times, force = read_force_history(tmp_path / "force.csv")
    np.testing.assert_array_equal([times, force], [[0, 1], [1, 2]])


@pytest.mark.parametrize("first", ["0,nan", "inf,1", "-Infinity,x", "0,one", "zero,1", "0s,1N", "-.5s,-1N", "+1 s,F"])
def test_a_first_row_with_a_number_is_no_header(tmp_path, first):
    """It would vanish, and with it the beginning of the history."""
    (tmp_path / "force.csv").write_text(f"{first}\n1,2\n2,3\n")
    with pytest.raises(ValueError, match=r"not readable|each larger than|finite") as error:
        impulses(*read_force_history(tmp_path / "force.csv")[::-1])
    one_line(error)


@pytest.mark.parametrize("content", ["", "time,force\n", "time,force\n0,1\n", "a,b\nc,d\n", "0,1\n1\n", "0 1\n1 2\n"])
def test_files_without_two_rows_of_two_numbers_are_refused(tmp_path, content):
    (tmp_path / "force.csv").write_text(content)
    with pytest.raises(ValueError, match=r"force.csv: .*two columns, time and force") as error:
        read_force_history(tmp_path / "force.csv")
    one_line(error)
