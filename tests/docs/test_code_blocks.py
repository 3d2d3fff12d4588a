"""The blocks of code in README and docs/ run, in the order in which they stand on a page."""

import contextlib
import io
import re
import shlex

import pytest
import yaml
from matplotlib.testing.compare import compare_images

from support.documentation import PAGES, README, ROOT, blocks
from support.workflow import merged, read_settings
from viscorough.cli import main
from viscorough_study.run.settings import check_settings

RUN = {page: [block for block in blocks(page) if block.language in ("python", "console")] for page in PAGES}


@pytest.fixture(autouse=True)
def in_a_new_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def run_page(page):
    names = {}
    for block in RUN[page]:
        if block.language == "python":
            exec(compile("\n" * block.line + block.text, page, "exec"), names)
        else:
            run_console(block.text)


def run_console(text):
    """Run the lines that start with "$"; what they print must match the lines below, where ... stands for any text."""
    for line, expected in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE):
        command, *arguments = shlex.split(line)
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            assert (command, main(arguments)) == ("viscorough", 0), line
        pattern = ".*".join(re.escape(piece) for piece in expected.split("..."))
        assert re.fullmatch(pattern, printed.getvalue()), printed.getvalue()


@pytest.mark.parametrize("page", [page for page in PAGES if RUN[page] and page != README], ids=lambda page: page.stem)
def test_blocks_run(page):
    run_page(page)


def test_readme_makes_the_picture_that_it_shows(tmp_path):
    run_page(README)
    assert compare_images(ROOT / "docs/own_surface.png", tmp_path / "own_surface.png", tol=1) is None


def test_settings_shown_are_valid():
    schema = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text(encoding="utf-8"))
    examples = [yaml.safe_load(block.text) for page in PAGES for block in blocks(page) if block.language == "yaml"]
    assert len(examples) >= 2
    for settings in examples:
        check_settings(merged(read_settings("config"), settings), schema)
