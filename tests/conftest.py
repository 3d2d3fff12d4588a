"""The order of the tests, and their threads."""

import os

# One thread for each of the processes that run tests side by side; before numpy is imported, which reads this.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def pytest_collection_modifyitems(items):
    """Long tests first, so that no worker is left alone with one: whole targets, then other runs of the workflow."""
    items.sort(key=lambda item: (item.path.stem != "test_targets", "workflow" not in item.path.parts))
