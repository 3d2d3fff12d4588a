"""The contract of the library for a user's mistake: an error of one line. That of the command line is in its tests."""

import contextlib

import pytest


@contextlib.contextmanager
def refused(what):
    """Context in which a ValueError of one line that matches `what` must be raised."""
    with pytest.raises(ValueError, match=what) as error:
        yield error
    assert len(str(error.value).splitlines()) == 1
