"""The blocks of code in README and docs/ run, in the order of the page; examples in docstrings run, too."""

import doctest

import pytest
import yaml
from matplotlib.testing.compare import compare_images

import viscorough
from support.code_blocks import run_console, run_python, run_shell
from support.documentation import PAGES, README, ROOT, blocks
from support.workflow import merged, read_settings
from viscorough import mdr, reference
from viscorough.media.medium import Medium
from viscorough.surfaces import self_affine
from viscorough_study.run.settings import check_settings

RUN = {page: [block for block in blocks(page) if block.language in ("python", "console", "shell")] for page in PAGES}


@pytest.mark.parametrize("page", [page for page in PAGES if RUN[page]], ids=lambda page: page.stem)
def test_blocks_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in RUN[page]:
        if block.language == "python":
            run_python(block.text, page, block.line, names)
        elif block.language == "console":
            run_console(block.text)
        else:
            run_shell(block.text)
    if page == README:
        assert compare_images(ROOT / "docs/own_surface.png", tmp_path / "own_surface.png", tol=1) is None


def test_settings_shown_are_valid():
    examples = [yaml.safe_load(block.text) for page in PAGES for block in blocks(page) if block.language == "yaml"]
    assert len(examples) >= 2
    for settings in examples:
        check_settings(merged(read_settings("config"), settings))


FORMULAS = [name for name, item in vars(reference).items() if getattr(item, "__module__", "") == reference.__name__]
PUBLIC = {name: getattr(viscorough, name) for name in viscorough.__all__ if name != "reference"}
PUBLIC |= {f"reference.{name}": getattr(reference, name) for name in FORMULAS if not name.startswith("_")}
# The documentation names these with their modules.
PUBLIC |= {item.__name__: item for item in (Medium, mdr.line_of_map, mdr.line_of_surface, self_affine.cut_disc)}


@pytest.mark.parametrize("name", PUBLIC)
def test_examples_in_docstrings_run(name):
    (test,) = (each for each in doctest.DocTestFinder(recurse=False).find(PUBLIC[name], name))
    assert test.examples, "no example"
    report = []
    assert doctest.DocTestRunner().run(test, out=report.append).failed == 0, "".join(report)
