"""Run the command line, also as `python -m viscorough`. Ctrl-C during the slow imports ends the process quietly."""

import signal

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C during the imports ends the process without a traceback

from viscorough.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
