"""The library's contract for a user's mistake: an error of one line. Tests of the command line have their own."""

import contextlib
import re

import pytest

# Options that messages may show as parts of whole commands: of rio, and of viscorough march.
_OF_WHOLE_COMMANDS = {"--crs", "--dst-crs", "--medium", "--method"}


@contextlib.contextmanager
def refused(what):
    """Require a ValueError of one line that matches `what` and names no option."""
    with pytest.raises(ValueError, match=what) as error:
        yield error
    assert len(str(error.value).splitlines()) == 1
    assert set(re.findall(r"--[a-z][\w-]*", str(error.value))) <= _OF_WHOLE_COMMANDS
