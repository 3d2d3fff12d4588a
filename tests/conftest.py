"""The order of the tests, their threads, and figures without a display."""

import os

# Give one thread to each of the processes that run tests in parallel. numpy reads this when it is imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("MPLBACKEND", "agg")


def pytest_collection_modifyitems(items):
    """Run long tests first, so no worker is left alone with one: whole targets, then other runs of the workflow."""
    items.sort(key=lambda item: (item.path.stem != "test_targets", "workflow" not in item.path.parts))
