"""What this documentation needs beyond Sphinx: our docstrings as reStructuredText, MathML, and the texts of --help."""

import importlib
import inspect
import re

import click
from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.utils.math import latex2mathml

from viscorough.cli import cli

_ENTRY = re.compile(r"(\w+(?:, \w+)*) : (.*)")  # of a list of parameters or attributes: names, and what they are
# Texts beside the docs that pages here include: pages link to the files, so that they can also be read unbuilt.
_PAGE_OF = {"../config/README.md": "settings.md", "../results/README.md": "output.md", "../README.md": "index.md"}


def to_rst(lines):
    """Lines of a docstring of this project as lines of reStructuredText.

    Lines "name : meaning" are a list of parameters or attributes, lines "- text" another list; both are continued by
    indented lines, and other indented lines are formulas or commands. `Names` stand between single backticks. No other
    sign is markup.
    """
    rst, kind = [], "blank"
    for line in lines:
        last, kind = kind, _kind(line, kind)
        if kind != last:
            rst += ["", "::", ""] if kind == "literal" else [""]
        text = _escaped(line.strip())
        if kind == "entries" and (entry := _ENTRY.fullmatch(line)):
            names = ", ".join(f"``{name}``" for name in entry[1].split(", "))
            rst += [names, f"    {_escaped(entry[2])}"]
        elif kind == "literal":
            rst.append(line)
        else:
            rst.append({"entries": "    ", "items": "  " * line.startswith(" ")}.get(kind, "") + text)
    return [*rst, ""]


def _kind(line, last):
    """What a line belongs to, given that of the line before."""
    if not line.strip():
        return "blank"
    if line.startswith(" "):
        return last if last in ("entries", "items", "literal") else "literal"
    if _ENTRY.fullmatch(line):
        return "entries"
    return "items" if line.startswith("- ") else "prose"


def _escaped(text, signs=r"([*|_\\:])"):
    """Text in which only `names` between backticks are marked up."""
    pieces = text.split("`")
    pieces[::2] = [re.sub(signs, r"\\\1", piece) for piece in pieces[::2]]
    return "``".join(pieces)


class CommandHelp(Directive):
    """The text that `viscorough COMMAND --help` prints; the argument is the command."""

    required_arguments = 1

    def run(self):
        command = cli.commands[self.arguments[0]]
        context = click.Context(command, info_name=f"viscorough {command.name}", terminal_width=100)
        text = command.get_help(context)
        return [nodes.literal_block(text, text, language="none")]


class TableColumns(Directive):
    """The columns of a table: meaning and unit, from `COLUMNS`, or from the second argument, of a module."""

    required_arguments, optional_arguments = 1, 1

    def run(self):
        module, name = [*self.arguments, "COLUMNS"][:2]
        columns = getattr(importlib.import_module(module), name)
        rows = [("column", "unit", "meaning"), *((name, unit or "", text) for name, (text, unit) in columns.items())]
        head, *body = [nodes.row("", *(nodes.entry("", nodes.paragraph("", cell)) for cell in row)) for row in rows]
        widths = [nodes.colspec(colwidth=width) for width in (20, 10, 70)]
        return [nodes.table("", nodes.tgroup("", *widths, nodes.thead("", head), nodes.tbody("", *body), cols=3))]


def _visit_inline_math(writer, node):
    writer.body.append(latex2mathml.tex2mathml(node.astext(), as_block=False))
    raise nodes.SkipNode


def _visit_math_block(writer, node):
    writer.body.append(f'<div class="math">{latex2mathml.tex2mathml(node.astext(), as_block=True)}</div>')
    raise nodes.SkipNode


def _link_to_pages(_app, _page, source):
    for path, page in _PAGE_OF.items():
        source[0] = source[0].replace(f"]({path}", f"]({page}")


def _convert_docstring(_app, _what, _name, _object, _options, lines):
    """Docstrings with sections are left to napoleon, with `names` and signs of formulas as in the others."""
    if any(re.fullmatch("-{4,}", line) for line in lines):
        lines[:] = [line if line.lstrip().startswith((">>>", "...")) else _escaped(line, r"([*|])") for line in lines]
    else:
        lines[:] = to_rst(lines)


def _restore_property(_app, what, _name, item, _options, lines):
    """What stands before a colon in the docstring of a property, which napoleon takes for its type."""
    if what == "property":
        lines[:] = to_rst((inspect.getdoc(item) or "").splitlines())


def _skip_tuple_fields(_app, _what, _name, member, _skip, _options):
    """Fields of a NamedTuple are described in its docstring; by themselves they are aliases of numbers."""
    return True if type(member).__name__ == "_tuplegetter" else None


def setup(app):
    app.add_html_math_renderer("mathml", (_visit_inline_math, None), (_visit_math_block, None))
    app.add_directive("command-help", CommandHelp)
    app.add_directive("table-columns", TableColumns)
    app.connect("source-read", _link_to_pages)
    app.connect("autodoc-process-docstring", _convert_docstring, priority=400)  # before napoleon
    app.connect("autodoc-process-docstring", _restore_property, priority=600)
    app.connect("autodoc-skip-member", _skip_tuple_fields)
    return {"parallel_read_safe": True}
