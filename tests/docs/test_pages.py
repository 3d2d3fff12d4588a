"""README and docs/: links lead somewhere, and everything that a page names exists."""

import re

import pytest

from support.documentation import MAKEFILES, PAGES, ROOT, anchors, links, prose, read
from support.workflow import FIGURES, RULE_FILES, RULES, TABLES
from viscorough.cli import cli
from viscorough_study.run.cases import POOLS

WORKFLOW = "\n".join(map(read, RULE_FILES))
NAMED = {*RULES, "tabulate_departures", "plot_departures"}
NAMES = [str(page.relative_to(ROOT)) for page in PAGES]


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_links_lead_to_files_and_headings(page):
    for link in links(prose(page)):
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        assert target.exists(), link
        assert ROOT in target.parents, link
        assert not anchor or anchor in anchors(target), link


def is_made(path):
    """Return True if a rule or a command of make makes a file of results/, or something in a folder of results/."""
    folder, _, name = path.partition("/")
    listed = {"figures": FIGURES, "tables": TABLES, "ensembles": POOLS}.get(folder, {})
    return name.partition(".")[0] in listed or f"results/{path}" in WORKFLOW + MAKEFILES


def test_results_page_names_only_files_that_are_made():
    """The names are in the first column. A name without a folder is in results/ or in the folder named before it."""
    cells = re.findall(r"^\| (`.*?) \|", read(ROOT / "results/README.md"), re.MULTILINE)
    assert len(cells) > 20
    for cell in cells:
        folder = ""
        for name in re.findall(r"`(\w[^`]*)`", cell):
            if name.endswith("/"):
                assert is_made(f"{name.partition('/')[0]}/"), cell
                continue
            folder = name.rpartition("/")[0] or folder
            assert is_made(name) or is_made(f"{folder}/{name}"), f"{name} in {cell}"


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_indices_of_symbols_are_formulas(page):
    """Markdown would show the underscore of a symbol in italics followed by an index, such as *κ*_c."""
    assert not re.findall(r"\w\*_\w", prose(page))


def test_page_of_commands_has_a_heading_for_each():
    text = read(ROOT / "docs/reference/command_line.md")
    headings = re.findall(r"^## (\w+)$", text, re.MULTILINE)
    assert headings == re.findall(r"^\.\. command-help:: (\w+)$", text, re.MULTILINE) == list(cli.commands)
    assert set(headings) == set(re.findall(r"^\| \[(\w+)\]\(#\1\)", text, re.MULTILINE))


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_everything_that_a_page_names_exists(page):
    """Checked are targets of make and of the workflow, figures and tables that rules make, and files of the project."""
    text = read(page)
    if page.name == "CHANGELOG.md":
        return  # it also names things that no longer exist
    for targets in re.findall(r"(?:^|`|=\S* |; )make ([a-z][a-z -]*)", text, re.MULTILINE):
        for target in targets.split():
            assert re.search(rf"^{target}:", MAKEFILES, re.MULTILINE), target
    for folder, name in re.findall(r"`results/(figures|tables)/(\w+)", text):
        assert is_made(f"{folder}/{name}"), name
    for path in re.findall(r"`((?:src|workflow|config|resources|benchmarks|profiles|examples|peers)/[\w./]+)`", text):
        assert (ROOT / path).exists() or f"\n`{path}`:\n" in text, path
    for command in re.findall(r"`snakemake ([^`]*)`", text):
        for word in command.split():
            assert word in NAMED or not re.fullmatch(r"[a-z_]+\w*", word), word
            assert (ROOT / word).exists() or not word.startswith(("config/", "profiles/")), word
