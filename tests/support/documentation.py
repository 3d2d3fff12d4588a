"""The documentation as text: pages, their links, headings and blocks of code."""

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
README = ROOT / "README.md"
PAGES = [
    *(README, ROOT / "CHANGELOG.md", ROOT / "CONTRIBUTING.md", ROOT / "config/README.md", ROOT / "results/README.md"),
    *sorted((ROOT / "docs").rglob("*.md")),
]
_FENCE = re.compile(r"^```(\S*)(?: [^\n]*)?\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@dataclass(frozen=True)
class Block:
    """Hold a block of code on a page: its language, its lines, and its line number on the page."""

    language: str
    text: str
    line: int


def read(page):
    return page.read_text(encoding="utf-8")


MAKEFILES = read(ROOT / "Makefile") + read(ROOT / "peers/targets.mk")


def blocks(page):
    """Return the blocks of a page in order."""
    return [
        Block(match[1], match[2], read(page)[: match.start()].count("\n") + 1) for match in _FENCE.finditer(read(page))
    ]


def prose(page):
    """Return a page without its blocks of code."""
    return _FENCE.sub("", read(page))


def links(text):
    """Return the targets of the links and pictures in a text that lead to files."""
    targets = re.findall(r"\]\(([^)\s]+)\)", text)
    return [target for target in targets if not re.match(r"\w+:", target)]


def anchors(page):
    """Return the anchors of a page's headings, as GitHub and the site make them."""
    headings = re.findall(r"^#+ (.*)$", prose(page), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}
