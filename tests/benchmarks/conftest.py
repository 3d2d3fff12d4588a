"""Benchmarks are scripts: they are loaded from their files."""

import importlib.util
import sys

import pytest

from support.workflow import ROOT


@pytest.fixture(scope="session")
def script():
    """The script of a name as a module."""

    def load(name):
        spec = importlib.util.spec_from_file_location(name, ROOT / f"benchmarks/{name}.py")
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module  # dataclasses look their module up
        spec.loader.exec_module(module)
        return module

    return load
