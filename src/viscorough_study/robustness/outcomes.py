"""Name the outcomes of stress tests, and count the results that are wrong without a warning."""

VERDICTS = ("holds", "model", "stated", "warned", "refused", "unnoticed")


def wrong_without_warning(table):
    """Return how many results of a failure map are wrong and come without a warning, as two numbers.

    The first number counts models outside their documented range, which are wrong by more than a factor of two. The
    second counts failures that go unnoticed.
    """
    counts = table["verdict"].value_counts()
    return int(counts.get("stated", 0)), int(counts.get("unnoticed", 0))
