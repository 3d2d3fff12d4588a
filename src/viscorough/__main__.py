"""The command `viscorough`, also as `python -m viscorough`: what must be in place before anything else is imported."""

import os
import signal


def _open_standard_streams() -> None:
    """Connect closed standard streams to the null device: a file opened later must not get one of their numbers."""
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # gets the lowest free number, which is this one


_open_standard_streams()
if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C during the imports ends the process without a traceback

from viscorough.cli import main  # noqa: E402

if __name__ == "__main__":
    raise SystemExit(main())
