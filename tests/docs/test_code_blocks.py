"""The blocks of code in README and docs/ run, in the order of the page.

The blocks on the page of the results run in tests/workflow/test_page.py, the blocks for workflows in tests/workflow.
"""

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml
from matplotlib.testing.compare import compare_images

from support.code_blocks import run_console, run_python, run_shell
from support.documentation import PAGES, README, ROOT, blocks, read
from support.workflow import merged, read_settings
from viscorough import read_load
from viscorough.io.medium_files import read_medium
from viscorough_study.run.settings import check_settings

RUN = {page: [block for block in blocks(page) if block.language in ("python", "console", "shell")] for page in PAGES}
# {beginning: name, reader}
FILES = {
    "time (ms)": ("force.csv", lambda name, unit: read_load(name, length_unit=unit)),
    "kind: ": ("medium.yaml", read_medium),
}
# Blocks that other tests read: directives of the website, the citation, scripts in examples/, and settings (below).
ELSEWHERE = {"bibtex", "{toctree}", "{include}", "{literalinclude}", "{csv-table}", "{eval-rst}", "yaml"}
# Blocks that are parts of a workflow, or need a package that is not installed here.
ALONE = ("rule tabulate_departures:", "use rule plot_surfaces as", "module viscorough:", "import numpy as np, tifffile")


@pytest.fixture(autouse=True)
def in_a_new_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def run_page(page):
    names = {}
    for block in RUN[page]:
        if block.language == "python":
            run_python(block.text, page, block.line, names)
        elif block.language == "console":
            run_console(block.text)
        else:
            run_shell(block.text)


@pytest.mark.parametrize("page", [page for page in PAGES if RUN[page] and page != README], ids=lambda page: page.stem)
def test_blocks_run(page):
    run_page(page)


def test_readme_makes_the_picture_of_the_guide(tmp_path):
    run_page(README)
    assert compare_images(ROOT / "docs/own_surface.png", tmp_path / "own_surface.png", tol=1) is None


# The cache of mypy keeps what it found in other packages, which is most of its work, for the next test session.
MYPY = [sys.executable, "-m", "mypy", "--config-file=", f"--cache-dir={ROOT / '.mypy_cache/pages'}"]
CHECKERS = {
    "mypy": [*MYPY, "--disable-error-code=import-untyped"],
    "pyright": ["pyright", "--pythonpath", sys.executable],  # a program of npm
}


@pytest.mark.long
@pytest.mark.parametrize("checker", [name for name in CHECKERS if name == "mypy" or shutil.which(name)])
def test_type_checkers_accept_the_blocks(tmp_path, checker):
    """All Python blocks of a page form one script, as a user would write it. Untyped packages are left out."""
    scripts = []
    for page in (README, ROOT / "docs/own_surface.md"):
        scripts.append(tmp_path / f"{page.stem.lower()}.py")
        scripts[-1].write_text("\n".join(block.text for block in RUN[page] if block.language == "python"))
    done = subprocess.run([*CHECKERS[checker], *scripts], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_files_shown_are_read():
    texts = [block.text for page in PAGES for block in blocks(page) if block.language == "text"]
    read_files = set()
    for text in texts:
        if text.startswith(ALONE):
            continue
        (name, reader) = next(FILES[beginning] for beginning in FILES if text.startswith(beginning))
        Path(name).write_text(text)
        reader(name, "m")
        read_files.add(name)
    assert read_files == {name for name, _ in FILES.values()}


def test_every_block_is_run_by_a_test():
    kinds = {block.language for page in PAGES for block in blocks(page)}
    assert kinds == {"python", "console", "shell", "text"} | ELSEWHERE


def test_extras_named_on_pages_exist():
    extras = tomllib.loads(read(ROOT / "pyproject.toml"))["project"]["optional-dependencies"]
    sources = [*PAGES, *(ROOT / "src/viscorough").rglob("*.py")]
    named = {name for file in sources for name in re.findall(r'pip\s+install "(?:\.|viscorough)\[(\w+)\]', read(file))}
    assert {"plot", "formats"} <= named <= set(extras)


def test_settings_shown_are_valid():
    examples = [yaml.safe_load(block.text) for page in PAGES for block in blocks(page) if block.language == "yaml"]
    assert len(examples) >= 2
    for settings in examples:
        check_settings(merged(read_settings("config"), settings))
