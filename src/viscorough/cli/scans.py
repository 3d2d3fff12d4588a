"""Evaluate many files of heights in parallel, and write one table; an interrupted run can be continued.

1. Take the rows of unchanged files from the table, or from the unfinished table of an earlier run.
2. Evaluate the other files in separate processes. After each file, write an unfinished table, TABLE.csv.unfinished.
3. Write the table and remove the unfinished table.

If a file cannot be evaluated, its row of the table states the reason, and the other files are evaluated. A run that is
interrupted or killed leaves the unfinished table, and does not change the table of an earlier run. Rows depend neither
on the order of the files nor on the number of processes.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
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
    from viscorough.io.load_tables import LoadRows, Rows

# Exit code if the table is complete, but some of its files have an error instead of results.
SOME_FAILED = 3
# These environment variables let libraries of linear algebra use one thread in each process. More threads would compete
# for the cores, and the rounding of results would depend on the number of threads.
_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
_DIED = "its process ended without a result, as happens if there is not enough memory; --jobs 1 needs less"


class Scan(NamedTuple):
    """File of heights to evaluate. A Scan can be pickled, so that it can be sent to another process.

    name : name of the file in the table
    surface : the file, with the options for reading and preparing it
    digest : digest (io.load_tables.digest_of_scan) of the file and the settings; "" if the file cannot be read
    evaluate : function with the arguments indenter and `progress`, which returns rows of the table and {column: unit}
    """

    name: str
    surface: surface_options.Surface
    digest: str
    evaluate: Callable[..., Rows]

    def is_in(self, finished: dict[str, LoadRows]) -> bool:
        """Return True if `finished`, {name of a file: its rows}, has rows of this file with the same settings."""
        return bool(self.digest) and self.name in finished and finished[self.name].digest == self.digest


def tabulate(
    surfaces: Sequence[surface_options.Surface],
    output: Path,
    evaluate: Callable[..., Rows],
    *,
    settings: dict[str, Any],
    jobs: int | None,
    threads: int,
    progress: bool | None,
) -> None:
    """Write the rows of all files as a table, and a closing line.

    surfaces : the files, which are all read and prepared with the same options
    evaluate : function with the arguments indenter and `progress`, which returns rows of the table and {column: unit};
        it must be picklable
    settings : {option: value} of all other options on which the rows depend; None for options that are not given
    jobs : number of files that are evaluated at a time; None for the number of cores divided by `threads`
    threads : number of threads that `evaluate` uses for each file
    progress : True or False to show or hide the progress; None to show it on a terminal

    If there is only one file, its error is raised. If some of several files have an error, Exit with SOME_FAILED is
    raised after the table is written.
    """
    from viscorough.io.load_tables import digest_of_scan, finished_rows

    label, unfinished = click.get_current_context().command_path, output.with_name(f"{output.name}.unfinished")
    for surface in surfaces:
        files.check_output(output, heights=surface.path)
    files.check_output(unfinished)
    surfaces[0].parsed()  # raises an error for a wrong option before any file is read
    spelled = _spelled(surfaces[0].options | settings)
    scans = []
    for name, surface in sorted({files.printable_path(surface.path): surface for surface in surfaces}.items()):
        digest = digest_of_scan(surface.path, f"{viscorough.__version__} {label} {spelled}")
        scans.append(Scan(name, surface, digest, evaluate))
    finished = finished_rows(output) | finished_rows(unfinished)
    results = {scan.name: finished[scan.name] for scan in scans if scan.is_in(finished)}
    unchanged, remaining = len(results), [scan for scan in scans if scan.name not in results]
    with messages.progress_bar(label, progress) as report:
        if len(scans) == 1:
            results |= {scan.name: _in_this_process(scan, report) for scan in remaining}
            listed = _write(results, output, spelled)
        else:
            try:
                with on_interrupt(signal.default_int_handler):
                    for result in _in_processes(remaining, jobs or max(1, _cores() // threads)):
                        results[result.file] = result
                        _write(results, unfinished, spelled)
                        report(len(results) / len(scans))
                    listed = _write(results, output, spelled)
                    unfinished.unlink(missing_ok=True)
            except KeyboardInterrupt:
                done = f"{len(results)} of {len(scans)} files are finished"
                messages.complain(label, f"interrupted: {done}; the same command continues")
                raise
    _close(output, listed, unchanged, label)


def _write(results: dict[str, LoadRows], path: Path, options: str) -> list[LoadRows]:
    """Write the rows of all files as a table; return the rows in the order and with the units of the table.

    results : {name of a file: its rows}
    options : text of the given options, which becomes an attribute of the table
    """
    from viscorough.io import load_tables, tables

    listed = load_tables.with_one_unit(results.values())
    tables.write(load_tables.load_table(listed, options=options), path)
    return listed


def only_one(surfaces: Sequence[surface_options.Surface], output: Path) -> surface_options.Surface:
    """Return the only file of heights. Raises UsageError for several files, since their results need a table."""
    text = f"{output}: {len(surfaces)} files of heights need a table; -o TABLE.csv, or one file at a time, is allowed"
    options.require(len(surfaces) == 1, text)
    return surfaces[0]


def rows_for_options(indenter: viscorough.Indenter, *, constants: dict[str, Any], **how: Any) -> Rows:
    """Return the rows of a table, one for each depth or force, and {column: unit}.

    constants : arguments of options.elasticity
    how : further arguments of io.scan_rows.rows_at_loads
    """
    from viscorough.io import scan_rows

    modulus, _ = options.elasticity(length_unit=indenter.length_unit, **constants)
    return scan_rows.rows_at_loads(indenter, shear_modulus=modulus, **how)


def _close(output: Path, listed: Sequence[LoadRows], unchanged: int, label: str) -> None:
    """Write the closing line of a table, one line about all warnings, and one line about all failures.

    listed : rows, or the error, of each file
    unchanged : number of files whose rows were taken from an earlier table

    Raises Exit if one of several files failed.
    """
    from viscorough.io.load_tables import text_of_row

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


def _in_this_process(scan: Scan, progress: Callable[[float], object]) -> LoadRows:
    """Evaluate a file in this process, and return its rows with the texts of the warnings.

    Errors are not caught. The command shows the warnings, too.
    """
    from viscorough.io.load_tables import LoadRows

    rows, units = scan.evaluate(scan.surface.read(), progress=progress)
    texts = messages.warning_texts(click.get_current_context().obj)
    return LoadRows(scan.name, scan.digest, rows, units, warnings="; ".join(texts))


def _in_a_process(scan: Scan) -> LoadRows:
    """Evaluate a file in a separate process, and return its rows, or the text of its error instead of rows."""
    from viscorough.io.load_tables import LoadRows
    from viscorough.io.scan_rows import evaluated

    with spelled_as_options():
        return evaluated(LoadRows(scan.name, scan.digest), scan.surface.path, scan.surface.read, scan.evaluate)


def _in_processes(scans: Sequence[Scan], jobs: int) -> Iterator[LoadRows]:
    """Evaluate files in parallel, and yield the rows or the error of each file as soon as it is finished.

    jobs : number of processes

    If a process dies, the files that are not finished are evaluated one at a time, each in a new process.
    """
    waiting = {scan.name: scan for scan in scans}
    try:
        with _processes(min(jobs, len(scans) or 1)) as submit:
            # Evaluate one file at a time until a file succeeds, so that the inner loops are compiled: several processes
            # that compile them at the same time can crash.
            for scan in scans:
                result = submit(scan).result()
                del waiting[result.file]
                yield result
                if not result.error:
                    break
            for future in as_completed([submit(scan) for scan in waiting.values()]):
                result = future.result()
                del waiting[result.file]
                yield result
    except BrokenProcessPool:
        for scan in waiting.values():
            yield _alone(scan)


def _alone(scan: Scan) -> LoadRows:
    """Evaluate a file in a new process, and return its rows or its error.

    If the process dies, the error states this.
    """
    from viscorough.io.load_tables import LoadRows

    try:
        with _processes(1) as submit:
            return submit(scan).result()
    except BrokenProcessPool:
        return LoadRows(scan.name, scan.digest, error=_DIED)


@contextlib.contextmanager
def _processes(count: int) -> Iterator[Callable[[Scan], Future[LoadRows]]]:
    """Yield a function that evaluates a file in one of `count` processes.

    The processes are spawned, not forked: a forked copy of this process could contain locks that no thread releases.
    The processes ignore Ctrl-C. They end if an error leaves this context, or if this process dies.
    """
    others, environment = set(multiprocessing.active_children()), {name: os.environ.get(name) for name in _ONE_THREAD}
    os.environ.update(_ONE_THREAD)
    pool = ProcessPoolExecutor(count, multiprocessing.get_context("spawn"), initializer=_end_with_parent)

    def submit(scan: Scan) -> Future[LoadRows]:
        with on_interrupt(signal.SIG_IGN):  # a process that starts here also ignores Ctrl-C
            return pool.submit(_in_a_process, scan)

    try:
        yield submit
    except BaseException:
        for process in set(multiprocessing.active_children()) - others:
            process.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)
        for name, value in environment.items():
            os.environ.pop(name)
            if value is not None:
                os.environ[name] = value


def _end_with_parent() -> None:
    """End this process when its parent process dies; otherwise this process would wait for work forever."""
    parent = multiprocessing.parent_process()

    def end() -> None:
        if parent is not None:
            parent.join()
        os._exit(1)

    threading.Thread(target=end, daemon=True).start()


def _cores() -> int:
    """Return the number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
