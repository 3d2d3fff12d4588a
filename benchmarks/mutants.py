"""Change the sources at random places in a copy of the project, and count the changes that tests detect.

    python benchmarks/mutants.py --mutants 200 --seed 1 --cores 2 --output results/mutants.json [--only NUMBER ...]

cosmic-ray makes the mutants: a different operator, comparison or number, a negated condition, a loop without
iterations. A module of src/ or workflow/scripts/ is drawn with a probability in proportion to its lines, then a place
in it, then a change there. Each mutant meets the tests that `make check` runs for its module (tests/changed.py); if it
survives, also the other tests of that folder and the tests that import the module. A script meets the tests that load
it, or a run of the workflow. A mutant is caught if a test fails, crashes, or does not end within the time limit; before
that, every test must pass without any change. The output lists every surviving mutant with its difference. Such a
mutant needs a test, unless it changes no result. The working tree is never changed.
"""

import ast
import contextlib
import difflib
import functools
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter, namedtuple
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue

import click
import cosmic_ray.plugins
import numpy as np
from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from measuring import generators, output_option, save
from project_copy import ROOT, copy_project, environment

sys.path.insert(0, str(ROOT / "tests"))
from changed import relevant_tests

CAUGHT, SURVIVED, CRASHED, ENDED, BROKEN = "caught", "survived", "crashed", "not finished", "tests did not run"
# {exit code of pytest, or of the command that kills it at the time limit: verdict}. 2: a module cannot be imported. 134
# and 139: the process was aborted, for example by a kernel that writes outside its arrays.
VERDICTS = {0: SURVIVED, 1: CAUGHT, 2: CAUGHT, 134: CRASHED, 139: CRASHED, -6: CRASHED, -11: CRASHED, -9: ENDED}
# Changes that no test needs to notice: `is` and `==` agree for None, and without a decorator kernels are only slower.
# Changes that any test notices are left out, too, since floats have no bits.
LEFT_OUT = re.compile(
    r"(Replace)?(ComparisonOperator_(Eq_Is|NotEq_IsNot|Is_Eq|IsNot_NotEq)|RemoveDecorator|"
    r"BinaryOperator_(Add|Sub|Mul|Div|FloorDiv|Mod|Pow)_(BitAnd|BitOr|BitXor|LShift|RShift))"
)
FULL_RUN = ["tests/workflow/test_full_run.py"]
# A changed source. number : number of the drawing; what : operator of cosmic-ray; text : text of the changed file
Mutant = namedtuple("Mutant", "number file line what text")


# ---- the mutants


def sources(root=ROOT):
    """Return {path from the root: text} of all modules that may be changed."""
    files = sorted([*root.glob("src/viscorough*/**/*.py"), *root.glob("workflow/scripts/*.py")])
    return {str(file.relative_to(root)): file.read_text(encoding="utf-8") for file in files}


def code_lines(text):
    """Return the number of lines with expressions, without comments and docstrings."""
    lines = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.expr) and not (isinstance(node, ast.Constant) and isinstance(node.value, str)):
            lines.update(range(node.lineno, node.end_lineno + 1))
    return len(lines)


def places(text):
    """Return {(kind of operator, line, column): [(operator, occurrence)]} of the changes of a module."""
    nodes, left_out, found = list(ast_nodes(get_ast(text))), _ranges_left_out(text), {}
    for name in cosmic_ray.plugins.operator_names():
        operator, short = cosmic_ray.plugins.get_operator(name), name.removeprefix("core/")
        if operator.arguments() or LEFT_OUT.fullmatch(short):
            continue
        positions = operator().mutation_positions
        starts = [start for node in nodes for start, _ in positions(node)]
        for occurrence, start in enumerate(starts):
            if not any(first <= start < last for first, last in left_out):
                found.setdefault((short.split("_")[0], *start), []).append((name, occurrence))
    return found


def _ranges_left_out(text):
    """Return (start, end) as (line, column) of every annotation, and of every decorator that compiles a function."""
    found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.arg, ast.AnnAssign)):
            found.append(node.annotation)
        elif isinstance(node, ast.FunctionDef):
            found += [node.returns, *(each for each in node.decorator_list if "njit" in ast.dump(each))]
    return [((node.lineno, node.col_offset), (node.end_lineno, node.end_col_offset)) for node in found if node]


def drawn(texts, seed, numbers):
    """Yield the mutants with these numbers; each depends on the sources, the seed and its number only."""
    files, places_in = list(texts), {}
    weights = np.array([code_lines(text) for text in texts.values()])
    for number, random in generators(seed, numbers):
        text = None
        while not _is_code(text):
            file = files[random.choice(len(files), p=weights / weights.sum())]
            if file not in places_in:
                places_in[file] = places(texts[file])
            if choices := places_in[file]:  # a module may have no place to change
                place = list(choices)[random.integers(len(choices))]
                name, occurrence = choices[place][random.integers(len(choices[place]))]
                text = mutate_code(texts[file], cosmic_ray.plugins.get_operator(name)(), occurrence)
        yield Mutant(number, file, place[1], name.removeprefix("core/"), text)


def _is_code(text):
    """Return True for a text without errors of syntax; a change of the star of `*arguments` makes one."""
    with contextlib.suppress(SyntaxError, TypeError):
        return bool(ast.parse(text))
    return False


def difference(mutant, text):
    """Return the lines that differ in a mutant."""
    lines = difflib.unified_diff(text.splitlines(), mutant.text.splitlines(), lineterm="", n=0)
    return [line for line in lines if not line.startswith(("---", "+++", "@@"))]


# ---- the tests


@functools.cache
def test_texts(root):
    """Return {path from the root: text} of all test files."""
    return {
        test.relative_to(root): test.read_text(encoding="utf-8") for test in sorted(root.glob("tests/**/test_*.py"))
    }


def area_tests(file, root=ROOT):
    """Return test files for a changed module; scripts that no test loads are tested by a run of the workflow."""
    if not file.startswith("workflow/"):
        return relevant_tests(file, root)
    call = f'load_script("{Path(file).stem}")'
    return sorted(str(test) for test, text in test_texts(root).items() if call in text) or FULL_RUN


def further_tests(file, root=ROOT):
    """Return further test files for a module that passes its area tests: of their folder, or that import the module."""
    if file.startswith("workflow/"):
        return []
    module, folder = Path(file).relative_to("src").with_suffix(""), Path("tests", *Path(file).parts[1:-1])
    name = re.compile(rf"{'[./]'.join(module.parts)}\b")
    found = set()
    for test, text in test_texts(root).items():
        # Whole packages would have too many.
        in_folder = test.parent == folder or (len(folder.parts) > 2 and test.is_relative_to(folder))
        if in_folder or name.search(text):
            found.add(str(test))
    return sorted(found - set(area_tests(file, root)))


def run_tests(tests, folder, time_limit, *options):
    """Return (exit code of pytest, its summary, seconds) of tests of a copy of the project."""
    command = ["timeout", "--signal=KILL", str(time_limit), sys.executable, "-m", "pytest", "-q", "-x"]
    # A comparison of a literal by `is` gives this warning; as an error it would keep the tests from running.
    command += ["-p", "no:cacheprovider", "-W", "ignore::SyntaxWarning", *options, *tests]
    began = time.perf_counter()
    run = subprocess.run(command, cwd=folder, env=environment(folder), capture_output=True, text=True, check=False)
    lines = [line for line in run.stdout.splitlines() if line.strip()] or run.stderr.splitlines() or [""]
    failed = [line for line in lines if line.startswith(("FAILED", "ERROR"))]  # the summary of pytest
    return run.returncode, (failed or lines)[-1], time.perf_counter() - began


def outcome(mutant, clean, folder, texts, stages, time_limit):
    """Return the outcome of one mutant as a dictionary for the file.

    stages : lists of tests, run until one of them fails
    """
    for name in ("src", "workflow"):
        shutil.rmtree(folder / name, ignore_errors=True)
        shutil.copytree(clean / name, folder / name)
    (folder / mutant.file).write_text(mutant.text, encoding="utf-8")
    code, began = 0, time.perf_counter()
    for tests in filter(None, stages):
        if code == 0:
            code, summary, _ = run_tests(tests, folder, time_limit)
    seconds = time.perf_counter() - began
    verdict, place = VERDICTS.get(code, BROKEN), {"number": mutant.number, "file": mutant.file, "line": mutant.line}
    change = {"change": mutant.what, "difference": difference(mutant, texts[mutant.file])}
    return {**place, **change, "verdict": verdict, "seconds": round(seconds, 1), "pytest": summary}


@click.command(help=__doc__.splitlines()[0])
@output_option
@click.option("--mutants", type=click.IntRange(1), default=200, show_default=True, help="Number of mutants.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Seed of all mutants.")
@click.option("--cores", type=click.IntRange(1), default=2, show_default=True, help="Mutants tested at a time.")
@click.option("--time-limit", type=click.IntRange(1), default=900, show_default=True, help="For one mutant [s].")
@click.option("--only", type=int, multiple=True, help="Number of a mutant; may be given more than once.")
def main(output, mutants, seed, cores, time_limit, only):
    texts = sources()
    chosen = list(drawn(texts, seed, only or range(mutants)))
    files = {mutant.file for mutant in chosen}
    stages = {file: [area_tests(file), further_tests(file)] for file in files}
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
        clean, folders, began = Path(temporary) / "clean", SimpleQueue(), time.perf_counter()
        copy_project(clean)
        (clean / "results").mkdir()
        every = sorted({test for lists in stages.values() for tests in lists for test in tests})
        code, summary, seconds = run_tests(every, clean, 36_000, "-n", str(cores))
        if code:
            raise click.ClickException(f"tests fail without any change: {summary}")
        click.echo(f"all tests without any change: {seconds:.0f} s")
        for core in range(cores):
            folders.put(shutil.copytree(clean, Path(temporary) / f"core{core}"))

        def tested(mutant):
            folder = folders.get()
            result = outcome(mutant, clean, folder, texts, stages[mutant.file], time_limit)
            folders.put(folder)
            click.echo("{number}, {file}:{line}: {verdict} ({seconds:.0f} s)".format(**result))
            return result

        with ThreadPoolExecutor(cores) as pool:
            results = list(pool.map(tested, chosen))
        seconds = round(time.perf_counter() - began)
    counts = Counter(result["verdict"] for result in results)
    survivors = [result for result in results if result["verdict"] in (SURVIVED, BROKEN)]
    for result in survivors:
        click.echo("\n".join(["", "{number}, {file}:{line}: {verdict}".format(**result), *result["difference"]]))
    click.echo("; ".join(f"{number} {verdict}" for verdict, number in counts.items()) + f"; {seconds} s in all")
    save({"seed": seed, "seconds": seconds, "counts": counts, "survivors": survivors, "results": results}, output)
    sys.exit(bool(survivors))


if __name__ == "__main__":
    main()
