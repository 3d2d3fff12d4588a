"""Convert results to datasets of xarray."""

import xarray as xr

from viscorough.io.datasets import content_to_dataset
from viscorough.io.saving import Result, to_content


def to_dataset(result: Result) -> xr.Dataset:
    """Convert a result to a labelled dataset of xarray.

    The dataset has the variables, coordinates and attributes of the NetCDF file that `viscorough.save` writes.

    Parameters
    ----------
    result : Indenter, LoadingCurve, Contact, Motion or Estimate
        Result of the library.

    Returns
    -------
    xarray.Dataset

    Raises
    ------
    TypeError
        For other objects.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, length_unit="m", seed=1)
    >>> dataset = viscorough.to_dataset(viscorough.contact_at(disc, depth=0.005))
    >>> dict(dataset.sizes), dataset.pressure.dims, dataset.x.attrs["units"]
    ({'y': 17, 'x': 17, 'patch': 1}, ('y', 'x'), 'm')
    """
    return content_to_dataset(to_content(result))
