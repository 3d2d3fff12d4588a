"""Compute digests of the source code of rules, so that an edit reruns exactly the rules that use the edited code.

Snakemake reruns a rule if its parameters changed since its last run. It ignores changes of the modules that a script
imports. A digest of these modules, given to the rule as a parameter, closes this gap. The digest covers the script and
all modules of our packages that it imports, directly or through other modules, including imports inside functions. The
digest is computed from syntax trees without docstrings, so wording, comments and layout do not change it. Tables (.csv)
in the folder `data` next to a module are part of the digest if the module names them. The syntax tree of a file, and
with it the digest, may differ between versions of Python.

Imports by names computed at run time are not followed. A name imported from a package itself may be looked up lazily,
and therefore counts as an import of all modules of the package.
"""

import ast
import hashlib
import json
import re
import sys
from pathlib import Path

from viscorough.io.atomic import atomic_write

PACKAGES = ("viscorough", "viscorough_study")
_WITH_DOCSTRING = (ast.Module, ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)


class SourceDigests:
    """Compute digests of scripts, and keep them in a cache file.

    Each module is read once. Its text is parsed again only if it has changed since the last run.

    folder : folder of the packages
    kept : path of the cache file
    """

    def __init__(self, folder, kept):
        self.folder, self._kept, self._modules = Path(folder), Path(kept), {}
        self._known = json.loads(self._kept.read_text()) if self._kept.is_file() else {}
        self._used = {}

    def digest(self, script):
        """Return the digest, sixteen hexadecimal digits, of a script and all modules that it uses; script : its path"""
        lines, used, waiting = [], set(), {Path(script)}
        while waiting:
            used.add(path := waiting.pop())
            waiting |= self._module(path)[1] - used
            name = path.relative_to(self.folder) if path.is_relative_to(self.folder) else path.name
            lines.append(f"{name}: {self._module(path)[0]}")
        return _digest("\n".join(sorted(lines)))

    def _module(self, path):
        """Return (digest of the syntax tree, set of the files of all imported modules) of a source file."""
        if path not in self._modules:
            text = path.read_text(encoding="utf-8")
            tables = {path.parent / "data" / name for name in re.findall(r"[\"'](\w+\.csv)[\"']", text)}
            contents = [table.read_text(encoding="utf-8") for table in sorted(tables) if table.is_file()]
            key = _digest("\n".join([_PARSED_BY, text, *contents]))
            self._used[key] = digest, names = self._known.get(key) or _parsed(text, contents)
            self._modules[path] = digest, set().union(*(self._files(name.split(".")) for name in names))
        return self._modules[path]

    def keep(self):
        """Write the cache file if its content has changed."""
        if self._used.keys() != self._known.keys():
            self._kept.parent.mkdir(exist_ok=True)
            with atomic_write(self._kept) as temporary:
                temporary.write_text(json.dumps(self._used))

    def _files(self, parts):
        """Return the set of source files to which an imported name refers; empty if the name is not in our packages.

        parts : parts of the dotted name, such as ["viscorough", "lines", "SelfAffineLines"]
        """
        for length in (len(parts), len(parts) - 1) if parts[0] in PACKAGES else ():
            place = self.folder.joinpath(*parts[:length])
            if place.with_suffix(".py").is_file():
                return {place.with_suffix(".py")}
            if place.is_dir():
                return set() if parts[-1] == "__version__" else set(place.rglob("*.py"))
        return set()


def _parsed(text, tables):
    """Return (digest of the syntax tree and of tables, imported names) of a module.

    text : source code of the module; tables : contents of the CSV tables that the module names
    """
    tree, names = ast.parse(text), set()
    for node in _statements(tree):
        if isinstance(node, _WITH_DOCSTRING) and ast.get_docstring(node, clean=False) is not None:
            del node.body[0]
        names.update(_imported_names(node))
    return _digest("\n".join([ast.dump(tree), *tables])), sorted(names)


def _statements(tree):
    """Yield all statements of a syntax tree, at any depth; a statement precedes the statements that it contains."""
    waiting = [tree]
    while waiting:
        yield (node := waiting.pop())
        for block in ("body", "orelse", "finalbody", "handlers", "cases"):
            waiting += getattr(node, block, ())


def _imported_names(node):
    """Return the dotted names that a statement imports.

    Raises ValueError for a relative import.
    """
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if not isinstance(node, ast.ImportFrom):
        return []
    if node.level:
        raise ValueError("relative imports are not followed; absolute ones are needed")
    return [f"{node.module}.{alias.name}" for alias in node.names]


def _digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:16]


_PARSED_BY = f"{sys.version}\n{Path(__file__).read_text(encoding='utf-8')}"
