"""The numbers and tables on README.md and the pages of docs/ are the published ones."""

import json
import re

import numpy as np
import pages
import pytest

from support.documentation import ROOT, read

VALUE = pages.published_claims().set_index(["claim", "case"])["value"]


def test_writing_the_pages_changes_nothing():
    blocks, numbers = pages.blocks(), pages.numbers()
    for page in pages.PAGES:
        assert pages.written(read(page), blocks, numbers) == read(page), page


def test_every_mark_has_a_text_and_every_text_has_a_mark():
    text = "\n".join(map(read, pages.PAGES))
    assert {match[2] for match in pages.BLOCK.finditer(text)} == set(pages.blocks())
    assert {match[2] for match in pages.NUMBER.finditer(text)} == set(pages.numbers())
    assert len(re.findall("by benchmarks/pages.py", text)) == len(pages.BLOCK.findall(text))
    assert text.count("<!--n:") == text.count("<!--/n-->") == len(pages.NUMBER.findall(text))
    # Markdown ends the paragraph before a line that begins with a comment.
    assert not re.search(r"^ *<!--n:", text, re.MULTILINE)


def test_marks_are_replaced_by_texts():
    text = "a <!--n:one-->0<!--/n--> %\n<!-- two: by benchmarks/pages.py -->\nold\n<!-- end of two -->\n"
    expected = "a <!--n:one-->3<!--/n--> %\n<!-- two: by benchmarks/pages.py -->\n\nnew\n\n<!-- end of two -->\n"
    for page in (text, expected):
        assert pages.written(page, {"two": "new\n"}, {"one": "3"}) == expected
    with pytest.raises(KeyError, match="one"):
        pages.written(text, {"two": "new\n"}, {})


def test_paragraph_has_no_line_that_would_begin_a_list():
    """Markdown takes a line that starts with a plus and a space as an item of a list."""
    for shift in range(130):
        lines = pages.paragraph("x" * shift + " H/(1 + H) and a - b " + "of many words " * 20).splitlines()
        assert not any(line.startswith(("+ ", "- ")) for line in lines)


def test_statements_in_words_follow_from_the_tables():
    """These statements are written by hand, and have to be changed if an assertion fails."""
    plateaus = dict(tuple(pages.results("plateaus").groupby("case_group")))
    assert plateaus["base"]["power_law_passes"].min() >= 0.95
    assert plateaus["base"]["control_passes"].max() == 0
    assert plateaus["base"]["decades_low"].min() >= 1.5 > plateaus["roll_off"]["decades_low"].max()
    assert 1.5 <= plateaus["roll_off"]["decades_high"].max() < 2
    assert VALUE["coincide"].abs()[["H = 0.6", "H = 0.9"]].max() < 0.02
    assert pages.results("reduction")["stiffness_ratio"].between(0.75, 1.25).all()
    assert 3e4 < VALUE["contact_problems", "changes of the contact"] < 4.5e4
    large = pages.results("large").query("across > 4000")
    assert (large["memory"] / large["elements"]).max() < 200
    curves = json.loads(read(ROOT / "docs/results/benchmarks.json"))["curve"]
    assert np.max([curve["force_error"] for curve in curves]) < 2e-5
