"""Docstrings as reStructuredText, formulas as MathML."""

import pytest
import sphinx_viscorough
from docutils.core import publish_string


def html(docstring):
    settings = {"halt_level": 2, "report_level": 2, "embed_stylesheet": False}
    text = "\n".join(sphinx_viscorough.to_rst(docstring.splitlines()))
    whole = publish_string(text, writer="html5", settings_overrides=settings).decode()
    return " ".join(whole.split("<main>")[1].split("</main>")[0].split())


@pytest.mark.parametrize(
    ("docstring", "contained"),
    [
        ("Slope |∇h| of E* and κ_n for x_ and *args: see", ["Slope |∇h| of E* and κ_n for x_ and *args: see"]),
        ("See `name`, `k_*`.", ['"docutils literal">name</span>', '"docutils literal">k_*</span>']),
        (
            "What.\nMore.\n\nx, y : shape (n,)\n    goes on\nz : text\nReturns it.",
            ["<p>What. More.</p>", "<p>shape (n,) goes on</p>", "<p>text</p>", "<p>Returns it.</p>"],
        ),
        ("Force\n    F = 1\n    G = 2\nare exact.", ["F = 1 G = 2</pre>", "<p>are exact.</p>"]),
        ("Either\n- one, which\n  goes on;\n- two.\nOr not.", ["one, which goes on;", "<li><p>two.", "<p>Or not.</p>"]),
    ],
)
def test_docstrings_are_shown_as_they_read(docstring, contained):
    page = html(docstring)
    assert "<em>" not in page
    assert all(text in page for text in contained), page
