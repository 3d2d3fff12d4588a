"""Spell the names of arguments in messages: in Python as arguments, on the command line as options.

A function of the library and a command can read the same input, and share their messages. Each message names arguments
by `argument`, which spells them as the caller gave them.
"""

import contextlib
from collections.abc import Iterator
from contextvars import ContextVar

_AS_OPTIONS = ContextVar("_AS_OPTIONS", default=False)


@contextlib.contextmanager
def spelled_as_options() -> Iterator[None]:
    """Let messages name options of the command line within this context."""
    token = _AS_OPTIONS.set(True)
    try:
        yield
    finally:
        _AS_OPTIONS.reset(token)


def spelled(option: str, argument: str) -> str:
    """Return the first text on the command line, and the second text in Python."""
    return option if _AS_OPTIONS.get() else argument


def argument(name: str, value: object = None, *, of: str = "") -> str:
    """Return an argument, and its value unless that is None, as the user gives it.

    of : function with this argument; only in Python, since the command line names its command anyway

    Examples
    --------
    >>> argument("lateral_unit"), argument("detrend", "plane")
    ('lateral_unit', "detrend='plane'")
    >>> with spelled_as_options():
    ...     argument("lateral_unit"), argument("detrend", "plane")
    ('--lateral-unit', '--detrend plane')
    """
    option = f"--{name.replace('_', '-')}"
    if value is not None:
        option, name = f"{option} {value}", f"{name}={value!r}"
    return spelled(option, f"{of}: {name}" if of else name)


def caller(function: str) -> str:
    """Return "function: " in Python, and nothing on the command line, which names its command anyway."""
    return spelled("", f"{function}: ")
