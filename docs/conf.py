"""Configure how Sphinx builds the pages of this folder into build/docs (`make docs`), without network access."""

import importlib.metadata
import re
from pathlib import Path

import click
import numpy.typing
from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.utils.math import latex2mathml
from sphinx.util.typing import stringify_annotation

from viscorough.basics import types
from viscorough.cli import cli

project = "viscorough"
release = importlib.metadata.version("viscorough")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
nitpicky = True  # a reference without a target is a warning, and warnings are errors
# Types of attributes, in words, and types of other packages and of annotations, which have no page here.
nitpick_ignore_regex = [
    ("py:class", r"array|bool|float|int|str|[A-Z]\w+|(numpy|matplotlib|xarray|os|collections|viscorough)\..*")
]
default_role = "code"  # `names` in docstrings
html_math_renderer = "mathml"

autodoc_default_options = {"members": True, "member-order": "bysource"}
autodoc_preserve_defaults = True
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
napoleon_google_docstring = False
napoleon_use_param = False
napoleon_use_rtype = False

html_theme = "furo"
html_title = f"viscorough {release}"
html_copy_source = False
html_show_sphinx = False

# Pages include texts from outside docs/. Links lead to these files, so they also work in the unbuilt pages.
_PAGE_OF = {"../config/README.md": "settings.md", "../results/README.md": "output.md", "../README.md": "index.md"}


# Columns of a block of code that the theme shows without scrolling.
_CODE_WIDTH = 84
# A symbol with an index, such as κ_c or τ_i.
_WITH_INDEX = re.compile(r"(?<![\w.])([^\W\d_])_(\w)(?!\w)")


def help_text(name):
    """Return the text of `viscorough COMMAND --help`, in lines that fit into a block of code."""
    settings = cli.context_settings | {"terminal_width": _CODE_WIDTH}
    context = click.Context(cli.commands[name], info_name=f"viscorough {name}", **settings)
    return cli.commands[name].get_help(context)


class CommandHelp(Directive):
    """Show the text of `viscorough COMMAND --help`; the argument is the command."""

    required_arguments = 1

    def run(self):
        text = help_text(self.arguments[0])
        return [nodes.literal_block(text, text, language="none")]


def _visit_math(writer, node):
    is_block = isinstance(node, nodes.math_block)
    formula = latex2mathml.tex2mathml(node.astext(), as_block=is_block)
    writer.body.append(f'<div class="math">{formula}</div>' if is_block else formula)
    raise nodes.SkipNode


def _link_to_pages(_app, _page, source):
    for path, page in _PAGE_OF.items():
        source[0] = source[0].replace(f"]({path}", f"]({page}")


# {text that Sphinx makes of a type: its name in the source code}
_SHORT_TYPES = {
    stringify_annotation(getattr(module, name), "smart"): name
    for module, names in (
        (numpy.typing, ["ArrayLike", "DTypeLike"]),
        (
            types,
            ["Array", "Integers", "Mask", "Numbers", "Scalar", "Several", "Seed", "FilePath", "Progress"],
        ),
    )
    for name in names
}


def _shorten_types(_app, _what, _name, _object, _options, signature, returned):
    """Write the names of types as in the source code, and the default options as a call."""
    texts = []
    for text in (signature, returned):
        for long in sorted(_SHORT_TYPES, key=len, reverse=True):  # long texts contain short ones
            text = text and text.replace(long, _SHORT_TYPES[long])
        texts.append(text and text.replace("= DEFAULT", "= SolverOptions()"))
    return tuple(texts)


def _skip_tuple_fields(_app, _what, _name, member, _skip, _options):
    """Leave out the fields of a NamedTuple, which Sphinx would show as aliases of numbers; its docstring has them."""
    return True if type(member).__name__ == "_tuplegetter" else None


def _lower_indices(_app, doctree):
    """Write indices of symbols in texts below the line; code and formulas stay as they are."""
    for text in list(doctree.findall(nodes.Text)):
        pieces = _WITH_INDEX.split(text)
        if len(pieces) == 1 or isinstance(text.parent, nodes.literal | nodes.literal_block | nodes.FixedTextElement):
            continue
        new = [nodes.Text(pieces[0])]
        for symbol, index, rest in zip(pieces[1::3], pieces[2::3], pieces[3::3], strict=True):
            new += [nodes.Text(symbol), nodes.subscript("", index), nodes.Text(rest)]
        text.parent.replace(text, new)


# The page of the results, if the workflow has made it, becomes a page of the site.
_RESULTS = Path(__file__).resolve().parents[1] / "results/index.html"


def _link_to_results(_app, page, source):
    if page == "index" and _RESULTS.exists():
        source[0] = source[0].replace("`results/index.html`", "<a href='results/index.html'>`results/index.html`</a>")


def _copy_results(app, error):
    if error is None and _RESULTS.exists():
        page = _RESULTS.read_text("utf-8").replace("../docs/index.md", "../index.html")
        (Path(app.outdir) / "results").mkdir(exist_ok=True)
        (Path(app.outdir) / "results/index.html").write_text(page.replace("../README.md", "../index.html"), "utf-8")


def setup(app):
    app.add_html_math_renderer("mathml", (_visit_math, None), (_visit_math, None))
    app.add_directive("command-help", CommandHelp)
    app.connect("source-read", _link_to_pages)
    app.connect("source-read", _link_to_results)
    app.connect("build-finished", _copy_results)
    app.connect("doctree-read", _lower_indices)
    app.connect("autodoc-process-signature", _shorten_types)
    app.connect("autodoc-skip-member", _skip_tuple_fields)
