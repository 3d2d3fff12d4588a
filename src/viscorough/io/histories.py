"""Read histories of force or depth from files."""

from viscorough.basics import units
from viscorough.basics.types import FilePath
from viscorough.io.atomic import path_named
from viscorough.io.columns import read_columns
from viscorough.media.load import Load


def read_load(path: FilePath, kind: str = "force", length_unit: str = units.UNKNOWN) -> Load:
    """Read a history of force or depth from a file with two columns.

    Parameters
    ----------
    path : path
        File (.csv or .npy) with times in the first column, and forces or depths in the second column.
    kind : {"force", "depth"}, optional
        Quantity in the second column.
    length_unit : str, optional
        Unit of length of the indenter, such as "um". Times are then converted to s, forces to N and depths to this
        unit, from the units in the heading of the file. By default all numbers are in consistent units, and a heading
        with units is refused.

    Returns
    -------
    Load

    Raises
    ------
    ValueError
        For a file that is missing or damaged, and for numbers that Load refuses. The one-line message names the file.

    Examples
    --------
    >>> import tempfile
    >>> import viscorough
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with open(f"{folder}/force.csv", "w") as file:
    ...         _ = file.write("t [ms],F [mN]\\n0,1\\n500,3\\n")
    ...     load = viscorough.read_load(f"{folder}/force.csv", length_unit="um")
    >>> load.time.tolist(), load.force.tolist()
    ([0.0, 0.5], [0.001, 0.003])
    """
    if kind not in ("force", "depth"):
        raise ValueError(f"kind {kind!r}; allowed: force, depth")
    unit = "N" if kind == "force" else length_unit
    times, values = read_columns(path, f"a {kind} history", {"time": "s", kind: unit}, length_unit)
    with path_named(path):
        return Load(times, **{kind: values})
