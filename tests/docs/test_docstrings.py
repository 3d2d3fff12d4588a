"""Docstrings of the public names: the parameters of the signature, and examples that run."""

import doctest
import inspect
import re

import pytest

import viscorough
from viscorough import mdr, reference
from viscorough.media.medium import Medium
from viscorough.surfaces import self_affine

FORMULAS = [name for name, item in vars(reference).items() if getattr(item, "__module__", "") == reference.__name__]
FORMULAS.append("one_element_stiffness")  # of elasticity, for the law as well
PUBLIC = {name: getattr(viscorough, name) for name in viscorough.__all__ if name != "reference"}
PUBLIC |= {f"reference.{name}": getattr(reference, name) for name in FORMULAS if not name.startswith("_")}
# The documentation names these with their modules.
PUBLIC |= {item.__name__: item for item in (Medium, mdr.line_of_map, mdr.line_of_surface, self_affine.cut_disc)}


@pytest.mark.parametrize("name", PUBLIC)
def test_examples_run(name):
    (test,) = (each for each in doctest.DocTestFinder(recurse=False).find(PUBLIC[name], name))
    assert test.examples, "no example"
    report = []
    assert doctest.DocTestRunner().run(test, out=report.append).failed == 0, "".join(report)


@pytest.mark.parametrize("name", [name for name, item in PUBLIC.items() if inspect.isfunction(item)])
def test_docstring_describes_every_parameter_of_the_signature(name):
    """Formulas whose one line names all arguments need no section of parameters."""
    text = inspect.getdoc(PUBLIC[name])
    if "reference." in name and "Parameters\n" not in text:
        return
    section = text.split("Parameters\n----------\n")[1].split("\n\n")[0]
    described = {
        each for line in re.findall(r"^\**(\w.*?)(?: :.*)?$", section, re.MULTILINE) for each in line.split(", ")
    }
    assert described == set(inspect.signature(PUBLIC[name]).parameters)
