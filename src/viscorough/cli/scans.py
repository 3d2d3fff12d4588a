"""Evaluate files of heights one after another, and write one table.

The table is written again after each file, so that it is whole at any time. If the same command is run again, also
after an interrupt, rows with the same digest of file and settings are kept, and the other files are evaluated. If a
file cannot be evaluated, its row states the reason. Rows depend neither on the order of the files nor on the number of
processes. A thousand scans are the work of the workflow (section `measured` of its settings), not of this module.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

import viscorough
from viscorough.basics.argument_names import spelled_as_options
from viscorough.basics.interrupts import on_interrupt
from viscorough.basics.units import Quantity
from viscorough.cli import files, messages, options, surface_options

if TYPE_CHECKING:
    from viscorough.io.contact_tables import FileRows, Rows

# Exit code if the table is complete, but some of its files have an error instead of results.
SOME_FAILED = 3
_DIED = "a process ended without a result, as happens if there is not enough memory; --jobs 1 needs less"


class _Job(NamedTuple):
    """File of heights to evaluate. A job can be pickled, so that it can be sent to another process.

    name : name of the file in the table
    file : the file, with the options for reading and preparing it
    digest : digest (io.contact_tables.digest_of_file) of the file and the settings; "" if the file cannot be read
    evaluate : function with the arguments indenter and `progress`, which returns rows of the table and {column: unit}
    """

    name: str
    file: surface_options.HeightsFile
    digest: str
    evaluate: Callable[..., Rows]


def tabulate(
    inputs: Sequence[surface_options.HeightsFile],
    output: Path,
    evaluate: Callable[..., Rows],
    *,
    settings: dict[str, Any],
    jobs: int,
    progress: bool | None,
) -> None:
    """Write the rows of all files as a table, and a closing line.

    inputs : the files, which are all read and prepared with the same options
    evaluate : function with the arguments indenter and `progress`, which returns rows of the table and {column: unit};
        it must be picklable
    settings : {option: value} of all other options on which the rows depend; None for options that are not given
    jobs : number of files that are evaluated at a time
    progress : True or False to show or hide the progress; None to show it on a terminal

    If there is only one file, its error is raised. If some of several files have an error, Exit with SOME_FAILED is
    raised after the table is written.
    """
    from viscorough.io.contact_tables import digest_of_file, rows_in_table

    label = click.get_current_context().command_path
    for each in inputs:
        files.check_output(output, heights=each.path)
    inputs[0].parsed()  # raises an error for a wrong option before any file is read
    spelled, earlier = _spelled(inputs[0].options | settings), rows_in_table(output)
    results, remaining = {}, []
    for name, file in sorted({files.printable_path(each.path): each for each in inputs}.items()):
        digest = digest_of_file(file.path, f"{viscorough.__version__} {label} {spelled}")
        if digest and name in earlier and earlier[name].digest == digest:
            results[name] = earlier[name]
        else:
            remaining.append(_Job(name, file, digest, evaluate))
    unchanged, count = len(results), len(results) + len(remaining)
    with messages.progress_bar(label, progress) as report:
        if count == 1:
            results |= {job.name: _single(job, report) for job in remaining}
        else:
            try:
                with on_interrupt(signal.default_int_handler):
                    for result in _each(remaining, jobs):
                        results[result.file] = result
                        _write(results, output, spelled)
                        report(len(results) / count)
            except KeyboardInterrupt:
                done = f"{len(results)} of {count} files are finished"
                messages.complain(label, f"interrupted: {done}; the same command continues")
                raise
    listed = _write(results, output, spelled)
    _close(output, listed, unchanged, label)


def _write(results: dict[str, FileRows], path: Path, options: str) -> list[FileRows]:
    """Write the rows of all files as a table; return the rows in the order and with the units of the table.

    results : {name of a file: its rows}
    options : text of the given options, which becomes an attribute of the table
    """
    from viscorough.io import contact_tables, tables

    listed = contact_tables.with_one_unit(results.values())
    tables.write(contact_tables.contact_table(listed, options=options), path)
    return listed


def only_one(inputs: Sequence[surface_options.HeightsFile], output: Path) -> surface_options.HeightsFile:
    """Return the only file of heights. Raises UsageError for several files, since their results need a table."""
    text = f"{output}: {len(inputs)} files of heights need a table; -o TABLE.csv, or one file at a time, is allowed"
    options.require(len(inputs) == 1, text)
    return inputs[0]


def rows_for_options(indenter: viscorough.Indenter, *, constants: dict[str, Any], **how: Any) -> Rows:
    """Return the rows of a table, one for each depth or force, and {column: unit}.

    constants : arguments of options.elasticity
    how : further arguments of io.contact_tables.rows_at_loads
    """
    from viscorough.io import contact_tables

    modulus, _ = options.elasticity(length_unit=indenter.length_unit, **constants)
    return contact_tables.rows_at_loads(indenter, shear_modulus=modulus, **how)


def _close(output: Path, listed: Sequence[FileRows], unchanged: int, label: str) -> None:
    """Write the closing line of a table, one line about all warnings, and one line about all failures.

    listed : rows, or the error, of each file
    unchanged : number of files whose rows were taken from an earlier table

    Raises Exit if one of several files failed.
    """
    from viscorough.io.contact_tables import text_of_row

    if len(listed) == 1:
        (result,) = listed
        text = text_of_row(result.rows[-1], result.units)
        messages.announce(output, text if len(result.rows) == 1 else f"{len(result.rows)} loads, the last at {text}")
        return
    failed, doubtful = ([each for each in listed if each.error], [each for each in listed if each.warnings])
    text = f"{sum(len(result.rows) for result in listed)} rows of {len(listed)} files"
    text += f", {unchanged} of them unchanged" if unchanged else ""
    messages.announce(output, text + (f", {len(failed)} failed" if failed else ""))
    if doubtful:
        first = f"the first is {doubtful[0].file}: {doubtful[0].warnings}"
        messages.complain(label, f"warning: {len(doubtful)} of {len(listed)} files have warnings; {first}")
    if failed:
        first = f"the first is {failed[0].file}: {failed[0].error}"
        messages.complain(label, f"{len(failed)} of {len(listed)} files failed; {first}")
        raise click.exceptions.Exit(SOME_FAILED)


def _spelled(values: dict[str, Any]) -> str:
    """Return {option: value} as text in the form of the command line, in alphabetical order of the options."""

    def text(value: Any) -> str:
        if isinstance(value, Quantity):
            return f"{value.number!r} {value.unit}".rstrip()
        return ",".join(map(text, value)) if isinstance(value, list | tuple) else str(value)

    given = {name.replace("_", "-"): value for name, value in sorted(values.items()) if value is not None}
    return " ".join(f"--{name}" if value is True else f"--{name} {text(value)}" for name, value in given.items())


def _single(job: _Job, progress: Callable[[float], object]) -> FileRows:
    """Evaluate the only file, and return its rows with the texts of the warnings.

    Errors are not caught. The command shows the warnings, too.
    """
    from viscorough.io.contact_tables import FileRows

    rows, units = job.evaluate(job.file.read(), progress=progress)
    texts = messages.warning_texts(click.get_current_context().obj)
    return FileRows(job.name, job.digest, rows, units, warnings="; ".join(texts))


def _rows_of(job: _Job) -> FileRows:
    """Evaluate a file, and return its rows, or the text of its error instead of rows."""
    from viscorough.io.contact_tables import FileRows, evaluated

    with spelled_as_options():
        return evaluated(FileRows(job.name, job.digest), job.file.path, job.file.read, job.evaluate)


def _each(remaining: Sequence[_Job], jobs: int) -> Iterator[FileRows]:
    """Yield the rows or the error of each file as soon as it is finished.

    jobs : number of processes. With more than one, the first files are evaluated in this process until one succeeds,
        so that the inner loops are compiled: several processes that compile them at the same time can crash
    """
    from viscorough.io.contact_tables import FileRows

    waiting, compiled = list(remaining), False
    while waiting and not (compiled and jobs > 1):
        result = _rows_of(waiting.pop(0))
        compiled = not result.error
        yield result
    if not waiting:
        return
    spawned = multiprocessing.get_context("spawn")  # a forked copy could contain locks that no thread releases
    with ProcessPoolExecutor(min(jobs, len(waiting)), spawned, _follow_parent) as pool:
        futures = {pool.submit(_rows_of, job): job for job in waiting}
        try:
            for future in as_completed(futures):
                try:
                    yield future.result()
                except BrokenProcessPool:
                    yield FileRows(futures[future].name, futures[future].digest, error=_DIED)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def _follow_parent() -> None:
    """Leave Ctrl-C to the parent process, and end this process when it dies; it would wait for work forever."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def end() -> None:
        if parent is not None:
            parent.join()
        os._exit(1)

    threading.Thread(target=end, daemon=True).start()
