"""Benchmarks are scripts: they are loaded from their files."""

import pytest

from support.benchmarks import load_benchmark


@pytest.fixture(scope="session")
def script():
    """The script of a name as a module."""
    return load_benchmark
