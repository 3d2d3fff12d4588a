"""The progress of a command, with an estimate of the time left, on standard error."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from viscorough.types import Progress

_DELAY = 1.0  # seconds: what is done sooner shows no progress


def progress_option(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add --progress/--no-progress to a command."""
    text = "Show progress on standard error, after a second  [default: if it is a terminal]"
    return click.option("--progress/--no-progress", default=None, help=text)(command)


@contextlib.contextmanager
def progress_bar(label: str, wanted: bool) -> Iterator[Progress]:
    """Context that yields a function of the share that is done, 0 to 1; from the first second on it is shown.

    wanted : True or False; None: only if standard error is a terminal. The bar is erased at the end, so that standard
        error holds nothing else than warnings and messages
    """
    from tqdm import tqdm

    bar = tqdm(
        total=1.0,
        desc=label,
        delay=_DELAY,
        disable=sys.stderr is None or (None if wanted is None else not wanted),  # None where it was closed
        leave=False,
        file=sys.stderr,
        bar_format="{desc}: {percentage:3.0f} % |{bar:30}| {elapsed} gone, about {remaining} left",
    )
    with bar:
        yield lambda done: bar.update(done - bar.n)
