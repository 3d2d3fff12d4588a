"""The methods `save` and `to_dataset` of results."""

from importlib import import_module
from typing import TYPE_CHECKING

from viscorough.types import FilePath

if TYPE_CHECKING:
    import xarray as xr


class Saved:
    """A result that `viscorough.save` can write."""

    def save(self, path: FilePath) -> None:
        """Write this to a file, atomically; see `viscorough.save`."""
        # By name: the formats are on a floor above, and what computes, whose source code a digest covers
        # (viscorough_study.run.source_digest), does not depend on them.
        import_module("viscorough.io.saving").save(self, path)

    def to_dataset(self) -> "xr.Dataset":
        """Return this as a labelled dataset of xarray, with the variables and attributes of its NetCDF file."""
        content = import_module("viscorough.io.saving").to_content(self)
        dataset: xr.Dataset = import_module("viscorough.io.datasets").dataset_of(content)
        return dataset
