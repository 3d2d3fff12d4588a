"""The method `save` of results."""

from importlib import import_module

from viscorough.types import FilePath


class Saved:
    """A result that `viscorough.save` can write."""

    def save(self, path: FilePath) -> None:
        """Write this to a file, atomically; see `viscorough.save`."""
        # By name: the formats are on a floor above, and what computes, whose source code a digest covers
        # (viscorough_study.run.source_digest), does not depend on them.
        import_module("viscorough.io.saving").save(self, path)
