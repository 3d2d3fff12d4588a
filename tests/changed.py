"""Print the tests for the changes since a commit: `python tests/changed.py [COMMIT]`, by default HEAD.

A module is tested by the test file of its name in the corresponding folder of tests, or by all files of that folder if
there is none. The imports of a module decide which jobs run again, so every change of a module also runs the test of
the source digests. Changes of the workflow and of pages run the quick tests of these.
"""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BY_FOLDER = {
    "src": ["tests/viscorough_study/run/test_source_digest.py"],
    "workflow": ["tests/workflow/test_run_with_progress.py"],
    "config": ["tests/viscorough_study/run/test_settings.py"],
    "resources": ["tests/viscorough_study/verdicts/test_claims.py", "tests/docs/test_quoted_numbers.py"],
    "docs": ["tests/docs/test_pages.py", "tests/docs/test_quoted_numbers.py"],
}


def changed(commit):
    """Return the files that differ from a commit, and those that git does not track yet."""
    commands = ["diff", "--name-only", "--diff-filter=d", commit], ["ls-files", "--others", "--exclude-standard"]
    runs = [subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=True) for words in commands]
    return [name for run in runs for name in run.stdout.splitlines()]


def relevant_tests(name, root=ROOT):
    """Return the test files for a changed file; paths are text, relative to the root."""
    path = Path(name)
    if path.name.startswith("test_"):
        return [name]
    if path.suffix != ".py" or path.parts[0] != "src":
        folder = {"Snakefile": "workflow", "README.md": "docs"}.get(name, path.parts[0])
        return [test for test in BY_FOLDER.get(folder, []) if (root / test).is_file()]
    mirror = Path("tests", *path.parts[1:-1], f"test_{path.name}")
    if (root / mirror).is_file():
        return [str(mirror)]
    return [str(test.relative_to(root)) for test in sorted((root / mirror.parent).glob("test_*.py"))]


if __name__ == "__main__":
    commit = sys.argv[1] if len(sys.argv) > 1 else "HEAD"
    names = changed(commit)
    tests = {test for name in names for test in relevant_tests(name)}
    tests |= {test for name in names if name.startswith("src/") for test in BY_FOLDER["src"]}
    print("\n".join(sorted(tests)))
