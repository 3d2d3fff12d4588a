"""The tests that `make check` selects for a changed file."""

from pathlib import Path

import pytest

import changed


@pytest.mark.parametrize(
    ("name", "some"),
    [
        ("tests/docs/test_pages.py", "tests/docs/test_pages.py"),
        ("src/viscorough/io/histories.py", "tests/viscorough/io/test_histories.py"),
        # All tests of its folder.
        ("src/viscorough/contact/state.py", "tests/viscorough/contact/test_prescribed_depth.py"),
        ("benchmarks/slurm.py", "tests/benchmarks/test_slurm.py"),
        ("Snakefile", "tests/workflow/test_form.py"),
        ("docs/theory.md", "tests/docs/test_quoted_numbers.py"),
    ],
)
def test_changed_file_selects_existing_tests(name, some):
    tests = changed.relevant_tests(name)
    assert some in tests
    assert all((changed.ROOT / Path(test)).is_file() for test in tests)


def test_files_without_tests_select_none():
    assert changed.relevant_tests("LICENSE") == changed.relevant_tests("examples/ball.py") == []
