"""The log of a job: one helper for every script, with warnings, tracebacks and progress in the same file."""

import logging
import sys
import traceback

from viscorough.errors import ConvergenceError


def log_to(path):
    """Log to a file, replacing it, and to stderr: messages, warnings and whatever ends the script early.

    The traceback of an uncaught exception goes to both; that of a ValueError or ConvergenceError, whose
    message says what is wrong, only to the file: stderr gets the message. An interrupt has none.
    """
    in_file, on_stderr = logging.FileHandler(path, mode="w", encoding="utf-8"), logging.StreamHandler()
    form = {"format": "%(asctime)s %(levelname)s %(message)s", "datefmt": "%Y-%m-%d %H:%M:%S"}
    logging.basicConfig(level=logging.INFO, handlers=[in_file, on_stderr], force=True, **form)
    logging.captureWarnings(True)
    logging.getLogger("fontTools").setLevel(logging.WARNING)  # else a figure's fonts fill pages

    def report(kind, error, trace):
        if issubclass(kind, KeyboardInterrupt):
            logging.error("interrupted")
            return
        logging.error("%s: %s", kind.__name__, " ".join(str(error).split()))
        details = "".join(traceback.format_exception(kind, error, trace)).rstrip()
        record = logging.root.makeRecord("root", logging.ERROR, __file__, 0, details, (), None)
        in_file.handle(record)
        if not issubclass(kind, (ValueError, ConvergenceError)):
            on_stderr.handle(record)

    sys.excepthook = report


class _LogStream:
    """What tqdm writes, as lines of the log."""

    def write(self, text):
        if line := text.strip():
            logging.info(line)

    def flush(self):
        pass


def progress(iterable, total, description):
    """The iterable; every 5 s of going through it, how far it is and how long it will take is logged."""
    from tqdm import tqdm

    return tqdm(
        iterable,
        total=total,
        desc=description,
        file=_LogStream(),
        mininterval=5,
        miniters=1,
        delay=5,
        bar_format="{desc}: {n_fmt} of {total_fmt}, {elapsed} passed, {remaining} to go, {rate_fmt}",
    )
