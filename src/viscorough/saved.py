"""The method `save` of results."""

from viscorough.types import FilePath


class Saved:
    """A result that `viscorough.save` can write."""

    def save(self, path: FilePath) -> None:
        """Write this to a file, atomically; see `viscorough.save`."""
        import viscorough  # the formats are on a floor above

        viscorough.save(self, path)  # type: ignore[arg-type]  # one of the classes that it takes
