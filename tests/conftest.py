"""The order of the tests."""


def pytest_collection_modifyitems(items):
    """Tests that run the workflow first: they take longest, and no worker should be left alone with one at the end."""
    items.sort(key=lambda item: "workflow" not in item.path.parts)
