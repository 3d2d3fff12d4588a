"""The contract of the library for a user's mistake: an error of one line. That of the command line is in its tests."""

import contextlib
import re

import pytest

# Options of commands that messages show as a whole: rio, and viscorough march.
_OF_WHOLE_COMMANDS = {"--crs", "--dst-crs", "--medium", "--method"}


@contextlib.contextmanager
def refused(what):
    """Context in which a ValueError of one line that matches `what`, and names no option, must be raised."""
    with pytest.raises(ValueError, match=what) as error:
        yield error
    assert len(str(error.value).splitlines()) == 1
    assert set(re.findall(r"--[a-z][\w-]*", str(error.value))) <= _OF_WHOLE_COMMANDS
