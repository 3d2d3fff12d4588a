"""Digests of the source code that a rule runs, so that an edit reruns exactly the rules that use what was edited.

Snakemake compares the parameters of a rule with those of its last run, but does not look into the modules that a script
imports. A digest of them as a parameter closes this gap. It covers the script and what the script uses of our packages,
directly or through other definitions: a function, class or constant counts only if it is reached from the script. It
is computed from syntax trees without docstrings, so that wording, comments and layout change no digest. The syntax
tree, and with it the digest, may differ between versions of Python.

Some statements of a module always count if anything of the module is used: decorated definitions, because a decorator
can register what it decorates, and every statement other than an import, a definition or an assignment to names,
because it runs for its effect. If a use cannot be followed, as with `from module import *` or a module that is passed
on as an object, the whole module counts. What is reached only through names computed at run time, such as getattr or
importlib, is not seen, except for the names that viscorough/__init__.py imports on first use (`LAZY_IMPORTS`).
"""

import ast
import hashlib
from functools import cached_property
from pathlib import Path

PACKAGES = ("viscorough", "viscorough_study")
LAZY_IMPORTS = "_MODULE_OF"  # table of a package: {name that it imports on first use: module of the package}
EVERYTHING = "*"  # stands for every name of a module
EFFECTS = ""  # stands for the statements of a module that always count


class SourceDigests:
    """Digests of scripts; each module is read once.

    folder : that of the packages
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self._modules, self._known_uses = {}, {}

    def digest(self, script, *functions):
        """Sixteen hexadecimal digits for a script and for what it uses of the packages.

        functions : dotted names of those that it imports by a name that is only known when it runs
        """
        lines = set()
        for path, names in self.used_names(script, *functions).items():
            about = path.relative_to(self.folder) if path.is_relative_to(self.folder) else path.name
            statements = (part for name in names for part in self._module(path).statements_of(name))
            lines |= {f"{about}: {statement.tree}" for statement in statements}
        return hashlib.sha256("\n".join(sorted(lines)).encode()).hexdigest()[:16]

    def used_names(self, script, *functions):
        """{file of a module: names that are used of it}, with `EVERYTHING` and `EFFECTS` among the names."""
        used, waiting = {}, [(Path(script), EVERYTHING)]
        waiting += [place for name in functions for place in self._locate(name.split("."))]
        while waiting:
            path, name = waiting.pop()
            names = used.setdefault(path, set())
            for new in {name, EFFECTS} - names:
                names.add(new)
                waiting += self._uses(path, new)
        return used

    def _module(self, path):
        if path not in self._modules:
            self._modules[path] = _Module(path)
        return self._modules[path]

    def _uses(self, path, name):
        """(file, name) of everything in the packages that the statements behind a name refer to."""
        if (path, name) not in self._known_uses:
            module, uses = self._module(path), set()
            for statement in module.statements_of(name):
                imports = module.imports | statement.imports
                for first, *rest in statement.references:
                    if first in module.definitions:
                        uses.add((path, first))
                    elif first in imports:
                        uses |= set(self._locate([*imports[first].split("."), *rest]))
            if "*" in module.imports:
                uses |= set(self._locate(module.imports["*"].split(".")))
            if name in module.imports and name not in module.definitions:  # handed on
                uses |= set(self._locate(module.imports[name].split(".")))
            self._known_uses[path, name] = uses
        return self._known_uses[path, name]

    def _locate(self, parts):
        """(file, name) of a dotted name and of the packages around it; nothing for packages other than ours."""
        place = self.folder
        for number, part in enumerate(parts if parts[0] in PACKAGES else ()):
            package, place = place / "__init__.py", place / part
            if place.with_suffix(".py").is_file():
                yield place.with_suffix(".py"), (parts[number + 1] if number + 1 < len(parts) else EVERYTHING)
                return
            if not place.is_dir():  # a name in the __init__ of the package
                module = self._module(package)
                if part in module.lazy_imports:
                    yield from self._locate([*parts[:number], *module.lazy_imports[part].split("."), *parts[number:]])
                elif part in module.definitions or part in module.imports or "__getattr__" not in module.definitions:
                    yield package, part
                elif part.startswith("__"):  # such as __version__, which no other module holds
                    yield package, "__getattr__"
                else:
                    raise ValueError(f"{package}: no table {LAZY_IMPORTS} says where {part} comes from")
                return
            if (place / "__init__.py").is_file():
                yield place / "__init__.py", (EFFECTS if number + 1 < len(parts) else EVERYTHING)


class _Module:
    """A parsed file.

    definitions : {name: statements}; imports : {bound name: dotted name}; effects : statements that always count
    """

    def __init__(self, path):
        self.everything, self.definitions, self.imports, self.effects = [], {}, {}, []
        for node in _without_docstrings(ast.parse(path.read_text(encoding="utf-8"))).body:
            statement, names = _Statement(node), _defined_names(node)
            self.everything.append(statement)
            if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                self.imports |= statement.imports
            if isinstance(node, ast.Import | ast.ImportFrom):
                continue
            if getattr(node, "decorator_list", ()) or not names:
                self.effects.append(statement)
            for name in names:
                self.definitions.setdefault(name, []).append(statement)

    def statements_of(self, name):
        """The statements behind a name: all of them for one that the module neither defines nor imports."""
        if name == EFFECTS:
            return self.effects
        if name in self.definitions:
            return self.definitions[name]
        return () if name in self.imports else self.everything

    @property
    def lazy_imports(self):
        """{name: module of the package that holds it} of a package that imports its names on first use."""
        for statement in self.definitions.get(LAZY_IMPORTS, ()):
            return ast.literal_eval(statement.node.value)
        return {}


class _Statement:
    """A statement of a module.

    imports : {bound name: dotted name} of all imports in it
    references : names in it, each with the attributes that follow it, such as ("timing", "timed")
    """

    def __init__(self, node):
        self.node, self.imports, self.references = node, {}, set()
        waiting = [node]
        while waiting:
            part = waiting.pop()
            if isinstance(part, ast.Name | ast.Attribute):
                attributes = []
                while isinstance(part, ast.Attribute):
                    attributes.append(part.attr)
                    part = part.value
                if isinstance(part, ast.Name):
                    self.references.add((part.id, *reversed(attributes)))
                    continue
            elif isinstance(part, ast.Import | ast.ImportFrom):
                self.imports |= _bound_names(part)
                continue
            waiting += ast.iter_child_nodes(part)

    @cached_property
    def tree(self):
        """The syntax tree as text."""
        return ast.dump(self.node)


def _bound_names(node):
    """{bound name: dotted name} of an import. Raises ValueError for a relative one."""
    if isinstance(node, ast.ImportFrom):
        if node.level:
            raise ValueError("relative imports are not followed; absolute ones are needed")
        return {alias.asname or alias.name: f"{node.module}.{alias.name}" for alias in node.names}
    packages = {alias.name.split(".")[0] for alias in node.names if not alias.asname}
    return dict(zip(packages, packages, strict=True)) | {
        alias.asname: alias.name for alias in node.names if alias.asname
    }


def _without_docstrings(node):
    """A module, with its docstring and those of everything defined in it removed."""
    if isinstance(node, ast.Module | ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef) and (
        ast.get_docstring(node, clean=False) is not None
    ):
        del node.body[0]
    for block in ("body", "orelse", "handlers", "finalbody"):
        for part in getattr(node, block, ()) if not isinstance(node, ast.expr) else ():
            _without_docstrings(part)
    return node


def _defined_names(node):
    """Names that a statement defines; none for one that does anything else."""
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return [node.name]
    if isinstance(node, ast.Assign | ast.AnnAssign):
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        parts = [part for target in targets for part in getattr(target, "elts", [target])]
        if all(isinstance(part, ast.Name) for part in parts):
            return [part.id for part in parts]
    return []
