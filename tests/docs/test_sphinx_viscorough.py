"""Docstrings as reStructuredText, formulas as MathML."""

import sys

import pytest
from docutils.core import publish_string

from support.documentation import ROOT


@pytest.fixture(scope="module")
def extension():
    sys.path.insert(0, str(ROOT / "docs"))
    try:
        import sphinx_viscorough

        return sphinx_viscorough
    finally:
        sys.path.remove(str(ROOT / "docs"))


def html(extension, docstring):
    settings = {"halt_level": 2, "report_level": 2, "embed_stylesheet": False}
    text = "\n".join(extension.to_rst(docstring.splitlines()))
    whole = publish_string(text, writer="html5", settings_overrides=settings).decode()
    return " ".join(whole.split("<main>")[1].split("</main>")[0].split())


def test_no_sign_is_markup(extension):
    shown = html(extension, "Slope |∇h| of E* and κ_n for x_ and *args: see `name`, `k_*`::")
    assert "Slope |∇h| of E* and κ_n for x_ and *args: see" in shown
    assert shown.count('<span class="docutils literal">') == 2
    assert "<em>" not in shown


def test_parameters_are_a_list(extension):
    shown = html(extension, "What.\nMore.\n\nx, y : shape (n,)\n    goes on\nz : text\nReturns it.\n\nEnd.")
    assert shown.count("<dt>") == 2
    assert shown.count("<dd>") == 2
    assert "<p>shape (n,) goes on</p>" in shown
    assert "<p>Returns it.</p>" in shown
    assert "<p>What. More.</p>" in shown


def test_indented_lines_are_formulas(extension):
    shown = html(extension, "Force\n    F = 1\n    G = 2\nare exact.")
    assert "F = 1 G = 2</pre>" in shown
    assert "<p>are exact.</p>" in shown


def test_items(extension):
    shown = html(extension, "Either\n- one, which\n  goes on;\n- two.\nOr not.")
    assert shown.count("<li>") == 2
    assert "one, which goes on;" in shown
    assert "<p>Or not.</p>" in shown
