"""Spell names in messages as the user knows them: as arguments in Python, as options on the command line.

A function of the library and a command of the command line can refuse the same input with the same message. Each
message therefore spells the name by `argument`: until_force in Python, --until-force on the command line.
"""

import contextlib
from collections.abc import Iterator
from contextvars import ContextVar

_AS_OPTIONS = ContextVar("_AS_OPTIONS", default=False)


@contextlib.contextmanager
def spelled_as_options() -> Iterator[None]:
    """Spell arguments as options of the command line in all messages that are made within this context."""
    token = _AS_OPTIONS.set(True)
    try:
        yield
    finally:
        _AS_OPTIONS.reset(token)


def spelled(option: str, argument: str) -> str:
    """Return the name that the user knows: `option` within the context `spelled_as_options`, otherwise `argument`."""
    return option if _AS_OPTIONS.get() else argument


def argument(name: str, value: object = None, *, of: str = "") -> str:
    """Return the spelling of an argument, with its value unless the value is None.

    of : name of the function that has the argument. It is added only in Python, because messages of the command line
        start with the name of the command

    Examples
    --------
    >>> argument("until_force"), argument("detrend", "plane")
    ('until_force', "detrend='plane'")
    >>> with spelled_as_options():
    ...     argument("until_force"), argument("detrend", "plane")
    ('--until-force', '--detrend plane')
    """
    option = f"--{name.replace('_', '-')}"
    if value is not None:
        option, name = f"{option} {value}", f"{name}={value!r}"
    return spelled(option, f"{of}: {name}" if of else name)


def caller(function: str) -> str:
    """Return the start of a message: "function: " in Python, and "" on the command line.

    The command line itself puts the name of the command before each message.
    """
    return spelled("", f"{function}: ")
