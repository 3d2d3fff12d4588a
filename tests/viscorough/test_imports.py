"""Packages that importing the library loads, its public names, and its annotations."""

import ast
import json
import re
import textwrap

import pytest

import viscorough
from support.command_line import python
from support.documentation import ROOT

pytestmark = pytest.mark.long

LIBRARY = ROOT / "src/viscorough"
REFERENCE = "".join(page.read_text() for page in (ROOT / "docs/reference").glob("*.md"))
PUBLIC = {"reference", *re.findall(r"^\.\. auto(?:function|class|exception):: (\w+)$", REFERENCE, re.MULTILINE)}
STUDY_ONLY = ("matplotlib", "pandas", "snakemake", "viscorough_study", "xarray")


def imported(script):
    """Return the top-level packages that a script imports, as reported by Python."""
    lines = python("-X", "importtime", "-c", script).stderr.splitlines()
    return {line.rsplit("|", 1)[1].strip().split(".")[0] for line in lines if line.startswith("import time:")}


def test_package_imports_no_slow_package():
    assert not imported("import viscorough") & {*STUDY_ONLY, "numpy", "numba", "scipy", "netCDF4", "click"}


def test_top_level_names_do_not_depend_on_earlier_imports():
    """Importing a module sets an attribute of the package, which would hide a public function of the same name."""
    script = textwrap.dedent("""
        import importlib, json, pkgutil, sys, viscorough
        if sys.argv[1:]:
            for module in pkgutil.walk_packages(viscorough.__path__, "viscorough."):
                importlib.import_module(module.name)
        assert {*viscorough.__all__, "__version__"} == set(dir(viscorough))
        objects = {name: getattr(viscorough, name) for name in viscorough.__all__}
        print(json.dumps({name: getattr(value, "__module__", value.__name__) for name, value in objects.items()}))
    """)
    before, after = (json.loads(python("-c", script, *arguments).stdout) for arguments in ([], ["everything"]))
    assert before == after
    assert set(before) == PUBLIC, "names of the package differ from those of the reference"


def test_documentation_has_every_public_name():
    guide = "\n".join(page.read_text() for page in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])
    assert not [name for name in viscorough.__all__ if not re.search(rf"\b{name}\b", guide)]
    assert len(viscorough.__all__) <= 33


def test_no_module_hides_an_import_in_a_text():
    """An import by a computed name could hide a circle from the contracts of imports."""
    importing = [path for path in LIBRARY.rglob("*.py") if re.search("import_module|__import__", path.read_text())]
    # Both import on first use what their own package consists of.
    assert set(importing) == {LIBRARY / "__init__.py", LIBRARY / "cli/__init__.py"}


def test_functions_that_messages_name_are_public():
    trees = [ast.parse(path.read_text()) for path in LIBRARY.rglob("*.py")]
    functions = {node.name for tree in trees for node in tree.body if isinstance(node, ast.FunctionDef)}
    raised = [node for tree in trees for node in ast.walk(tree) if isinstance(node, ast.Raise)]
    texts = [node.value for each in raised for node in ast.walk(each) if isinstance(node, ast.Constant)]
    named = {word for text in texts for word in re.findall(r"[a-z]+(?:_[a-z]+)+", str(text))} & functions
    assert "contact_at" in named
    assert named - {"length_unit"} <= PUBLIC  # length_unit is also the name of an argument


def test_unknown_names_are_refused():
    with pytest.raises(AttributeError, match="no attribute 'indentation'"):
        viscorough.indentation  # noqa: B018
