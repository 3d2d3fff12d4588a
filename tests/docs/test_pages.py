"""README and docs/: links lead somewhere, and the files and targets that a page names exist."""

import re

import pytest

from support.documentation import MAKEFILES, PAGES, ROOT, anchors, links, prose, read

PAGES = [page for page in PAGES if page.name != "CHANGELOG.md"]  # it also names things that no longer exist
NAMES = [str(page.relative_to(ROOT)) for page in PAGES]


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_links_lead_to_files_and_headings(page):
    for link in links(prose(page)):
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_files_and_targets_that_a_page_names_exist(page):
    text = read(page)
    for targets in re.findall(r"(?:^|`|=\S* |; )make ([a-z][a-z -]*)", text, re.MULTILINE):
        for target in targets.split():
            assert re.search(rf"^{target}:", MAKEFILES, re.MULTILINE), target
    for path in re.findall(r"`((?:src|workflow|config|resources|benchmarks|profiles|examples|peers)/[\w./]+)`", text):
        assert (ROOT / path).exists(), path
