"""Write messages, warnings and tracebacks of a job to its log file; every script of the workflow uses this module."""

import logging
import re
import sys
import traceback
from pathlib import Path

from viscorough.basics.errors import ConvergenceError
from viscorough_study.run.made_with import record_job
from viscorough_study.run.stale_locks import mark_as_running


def run_job(names, main):
    """Set up the log and the record of a Snakemake job, and call the script's `main` with its files and params.

    Do nothing if Snakemake does not run the script.

    An error leaves a file beside the log. If the resource `tries` then says that this is not the first try, the job
    ends at once, since another try would repeat the error.

    names : global names of the script, which contain `snakemake` in a job
    main : function of the named inputs, outputs and params of the rule. The param `source` is left out: it is the
        digest of the source code, which decides about reruns and is recorded.
    """
    if job := names.get("snakemake"):
        mark_as_running()
        log_to(job.log[0], f"{job.rule}, {next(iter(job.output))}: ")
        # Snakemake removes the log before another try.
        tries, failed = job.resources.get("tries", 1), Path(job.log[0]).with_suffix(".failed")
        if tries > 1 and failed.is_file():
            raise ValueError(f"not tried again after an error: {failed.read_text(encoding='utf-8')}")
        failed.unlink(missing_ok=True)
        record_job(job.rule, job.input, dict(job.params.items()))
        params = {name: value for name, value in job.params.items() if name != "source"}
        try:
            main(**job.input, **job.output, **params)
        except Exception as error:
            if not isinstance(error, MemoryError):
                failed.write_text(str(error), encoding="utf-8")
            if isinstance(error, ValueError) and _names_a_damaged_result(error):
                raise ValueError(f"{error}; remove the file, so that the next run makes it again") from error
            raise


def _names_a_damaged_result(error):
    """Return True if an error names a file of this workflow that cannot be read, and no remedy."""
    return re.match(r"\S*results/(ensembles|curves|surfaces)/\S+: not readable", str(error)) is not None


def log_to(path, place=""):
    """Log messages, warnings and uncaught exceptions to stderr and to a file, which is overwritten.

    The traceback of an uncaught exception is written to both. For a ValueError or ConvergenceError it is only written
    to the file, since the message suffices on stderr. For an interrupt no traceback is written.

    place : text before the message of an uncaught exception, which names the rule and the result. Snakemake itself
        names only a line in a file of rules.
    """
    in_file, on_stderr = logging.FileHandler(path, mode="w", encoding="utf-8"), logging.StreamHandler()
    form = {"format": "%(asctime)s %(levelname)s %(message)s", "datefmt": "%Y-%m-%d %H:%M:%S"}
    logging.basicConfig(level=logging.INFO, handlers=[in_file, on_stderr], force=True, **form)
    logging.captureWarnings(True)
    logging.getLogger("fontTools").setLevel(logging.WARNING)  # fontTools would log every font of a figure

    def report(kind, error, trace):
        if issubclass(kind, KeyboardInterrupt):
            logging.error("interrupted")
            return
        logging.error("%s%s: %s", place, kind.__name__, " ".join(str(error).split()))
        details = "".join(traceback.format_exception(kind, error, trace)).rstrip()
        record = logging.root.makeRecord("root", logging.ERROR, __file__, 0, details, (), None)
        in_file.handle(record)
        if not issubclass(kind, (ValueError, ConvergenceError)):
            on_stderr.handle(record)

    sys.excepthook = report
