"""The order of the tests, their threads, and figures without a display."""

import os

# One thread for each of the processes that run tests side by side; before numpy is imported, which reads this.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("MPLBACKEND", "agg")


def pytest_collection_modifyitems(items):
    """Long tests first, so that no worker is left alone with one: whole targets, then other runs of the workflow."""
    items.sort(key=lambda item: (item.path.stem != "test_targets", "workflow" not in item.path.parts))
