"""Plant faults in copies of the project, one at a time, and count how many the tests catch.

    python benchmarks/planted_faults.py --output results/planted_faults.json [--only NAME ...] [--tests TEST ...]

The faults are those of planted_faults.yaml in this folder: a text that occurs exactly once in a file, its replacement,
the tests to run, and the consequence of the fault. A fault is caught if one of its tests fails; before that, every test
must pass without any fault. The working tree is never changed.
"""

import shutil
import subprocess
import sys
import tempfile
import time
from collections import namedtuple
from pathlib import Path

import click
import yaml
from measuring import output_option, save
from project_copy import ROOT, copy_project, environment

FAULTS = Path(__file__).with_suffix(".yaml")
TIME_LIMIT = 3000  # seconds after which the tests of one fault are taken to hang, even on a busy machine
# {exit code of pytest, or of what kills it at the time limit with all that it has started: verdict}
VERDICTS = {0: "missed", 1: "caught", -9: "not finished"}
# The wrong text `new` in place of the right one; tests : arguments of pytest; why : consequence of the fault.
Fault = namedtuple("Fault", "name file old new tests why")


def read_faults():
    return [Fault(**fields) for fields in yaml.safe_load(FAULTS.read_text(encoding="utf-8"))]


def problems(fault):
    """Reasons, one per line, why a fault cannot be planted or its tests cannot run."""
    file, lines = ROOT / fault.file, []
    count = file.read_text(encoding="utf-8").count(fault.old) if file.is_file() else 0
    if count != 1:
        lines.append(f"{fault.name}: the old text occurs {count} times in {fault.file}; it must occur once")
    if not isinstance(fault.new, str) or fault.new == fault.old:
        lines.append(f"{fault.name}: the new text is {fault.new!r}; it must be another, in quotes if it is a number")
    for test in fault.tests:
        path, *names = test.split("[")[0].split("::")
        text = (ROOT / path).read_text(encoding="utf-8") if (ROOT / path).is_file() else ""
        if not (ROOT / path).exists() or any(f"def {name}(" not in text for name in names):
            lines.append(f"{fault.name}: there is no test {test}")
    return lines


def plant(fault, folder):
    """Write the wrong text, and remove compiled code that may contain the right one: numba compiles it into callers."""
    file = folder / fault.file
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace(fault.old, fault.new), encoding="utf-8")
    if "viscorough.compilation import" in text:
        for compiled in (folder / "src").rglob("*.nb[ic]"):
            compiled.unlink()


def run_tests(tests, folder, time_limit=TIME_LIMIT):
    """(exit code of pytest, its summary, seconds) of tests of a copy of the project."""
    command = ["timeout", "--signal=KILL", str(time_limit), sys.executable, "-m", "pytest", "-q", "-x", "-W", "ignore"]
    command += ["-p", "no:cacheprovider", *tests]
    began = time.perf_counter()
    run = subprocess.run(command, cwd=folder, env=environment(folder), capture_output=True, text=True, check=False)
    lines = [line for line in run.stdout.splitlines() if line.strip()] or run.stderr.splitlines() or [""]
    failed = [line for line in lines if line.startswith(("FAILED", "ERROR"))]  # its summary
    return run.returncode, (failed or lines)[-1], time.perf_counter() - began


def outcome(fault, clean, folder):
    """Outcome of one fault, as a dictionary for the file: caught, missed, or the reason why neither is known."""
    shutil.copytree(clean, folder)
    plant(fault, folder)
    code, summary, seconds = run_tests(fault.tests, folder)
    shutil.rmtree(folder)
    verdict = VERDICTS.get(code, "tests did not run")
    return {"name": fault.name, "verdict": verdict, "seconds": round(seconds, 1), "pytest": summary}


@click.command(help=__doc__.splitlines()[0])
@output_option
@click.option("--only", multiple=True, help="Name of a fault; may be given more than once  [default: all].")
@click.option("--tests", multiple=True, help="Test to run instead of those of each fault; repeatable.")
def main(output, only, tests):
    faults = [fault._replace(tests=tests or fault.tests) for fault in read_faults() if not only or fault.name in only]
    if unknown := set(only) - {fault.name for fault in faults}:
        raise click.UsageError(f"no fault has the name {', '.join(sorted(unknown))}")
    if lines := [line for fault in faults for line in problems(fault)]:
        raise click.ClickException("\n".join(lines))
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
        clean = Path(temporary) / "clean"
        copy_project(clean)
        (clean / "results").mkdir()
        tests = list(dict.fromkeys(test for fault in faults for test in fault.tests))
        code, summary, seconds = run_tests(tests, clean, TIME_LIMIT * len(faults))  # also compiles
        if code:
            raise click.ClickException(f"tests fail without any fault: {summary}")
        click.echo(f"all tests without any fault: {seconds:.0f} s")
        results = []
        for fault in faults:
            results.append(outcome(fault, clean, Path(temporary) / "planted"))
            click.echo("{name}: {verdict} ({seconds:.0f} s)".format(**results[-1]))
    caught = sum(result["verdict"] == "caught" for result in results)
    click.echo(f"{caught} of {len(faults)} faults caught")
    save({"faults": len(faults), "caught": caught, "results": results}, output)
    sys.exit(caught < len(faults))


if __name__ == "__main__":
    main()
