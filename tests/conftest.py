"""The order of the tests."""


def pytest_collection_modifyitems(items):
    """Long tests first, so that no worker is left alone with one: whole targets, then other runs of the workflow."""
    items.sort(key=lambda item: (item.path.stem != "test_targets", "workflow" not in item.path.parts))
