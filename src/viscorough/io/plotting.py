"""Draw one plain picture of each kind of result. Only this module of the library imports matplotlib."""

from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscorough.basics.summaries import shown_unit
from viscorough.basics.types import Array, FilePath
from viscorough.io.atomic import atomic_write
from viscorough.io.netcdf import Content, Variables
from viscorough.io.saving import Result, to_content
from viscorough.io.suffixes import FIGURES, check_suffix


class _Shown(Figure):
    """Figure that pyplot does not know, and thus does not keep, before it is shown."""

    def show(self, warn: bool = True) -> None:
        """Show the figure in a window, or below the cell of a notebook; scripts wait until the window is closed."""
        from matplotlib import pyplot

        manager = pyplot.figure().canvas.manager
        manager.canvas.figure = self  # type: ignore[union-attr]
        self.set_canvas(manager.canvas)  # type: ignore[union-attr]
        pyplot.show()


# Metadata of figures have no dates, so that the same result gives the same file.
_METADATA: dict[str, Any] = {".png": {}, ".pdf": {"CreationDate": None}, ".svg": {"Date": None}}
_STYLE: dict[Any, Any] = {"font.size": 9, "savefig.dpi": 200, "svg.hashsalt": "viscorough"}
# Names of axes. With the shear modulus, forces are F instead of F/G, and pressures p instead of p/G.
_AXES = {"heights": "height", "pressure": "pressure p/G", "normal_pressure": "pressure p"}
_AXES |= {"force": "force F/G", "normal_force": "force F"}
# The first of these maps that a file holds is drawn, or the first of these curves: (abscissa, ordinate, scale).
_MAPS = ("normal_pressure", "pressure", "heights")
_CURVES = [("time", "depth", "linear"), ("depth", "normal_force", "log"), ("depth", "force", "log")]
_CURVES += [("x", "heights", "linear")]


def plot(result: Content | Result, path: FilePath | None = None) -> Figure:
    """Draw a result: heights, pressures of a contact, force against depth, or depth against time.

    Parameters
    ----------
    result : tuple or Indenter or LoadingCurve or Contact or Motion or Estimate
        Result of the library, or the pair that io.netcdf.read returns for a file. Needs matplotlib: pip install
        "viscorough[plot]".
    path : path, optional
        File to write atomically (.png, .pdf or .svg). The same result gives the same bytes. By default none is written.

    Returns
    -------
    Figure
        Figure of matplotlib, which `.show()` shows, in the units of the file; metres become mm, µm or nm. Maps have the
        first row at the top. Of several contacts, the last is drawn. Loading curves have logarithmic axes.

    Raises
    ------
    ValueError
        For a suffix that is not allowed, and for a file that holds none of these results.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, length_unit="m", seed=1)
    >>> (axes,) = viscorough.plot(viscorough.indent(disc)).axes
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('depth (µm)', 'force F/G (µm2)')
    """
    suffix = "" if path is None else check_suffix(path, FIGURES)
    variables, _ = result if isinstance(result, tuple) else to_content(result)
    with mpl.rc_context(_STYLE):
        figure = _Shown(figsize=(4.6, 3.6), layout="compressed")
        axes = figure.subplots()
        maps = [name for name in _MAPS if name in variables and variables[name][0][-2:] == ("y", "x")]
        curves = [each for each in _CURVES if set(each[:2]) <= set(variables)]
        if maps and {"x", "y"} <= set(variables):
            _draw_map(figure, axes, variables, maps[0])
        elif curves:
            _draw_curve(axes, variables, *curves[0])
        else:
            raise ValueError("no heights, contact, curve or motion in it; a file that viscorough wrote is needed")
        if path is not None:
            with atomic_write(path) as temporary:
                figure.savefig(temporary, format=suffix[1:], metadata=_METADATA[suffix])
    return figure


def _draw_map(figure: Figure, axes: Axes, variables: Variables, name: str) -> None:
    """Draw a map, grey outside the indenter; of several maps, the last."""
    values, label = _drawn(variables, name)
    values = values.reshape(-1, *values.shape[-2:])[-1]
    size = max(np.abs(variables[axis][1]).max() for axis in ("x", "y"))  # both axes have one unit
    (x, x_label), (y, y_label) = (_drawn(variables, axis, size) for axis in ("x", "y"))
    ends: list[float] = []
    for position in (x, y):
        half = (position[-1] - position[0]) / max(len(position) - 1, 1) / 2 or 0.5
        ends += [position[0] - half, position[-1] + half]
    left, right, top, bottom = ends  # the first row is at the top
    image = axes.imshow(values, origin="upper", extent=(left, right, bottom, top))
    axes.set_facecolor("0.85")
    axes.set(xlabel=x_label, ylabel=y_label)
    figure.colorbar(image, ax=axes, label=label)


def _draw_curve(axes: Axes, variables: Variables, x: str, y: str, scale: Any) -> None:
    """Draw a curve, or all curves of a stack; logarithmic axes show positive values only."""
    (xs, x_label), (ys, y_label) = _drawn(variables, x), _drawn(variables, y)
    for along, over in zip(np.atleast_2d(xs), np.atleast_2d(ys), strict=True):
        shown = (along > 0) & (over > 0) if scale == "log" else np.isfinite(along + over)
        axes.plot(along[shown], over[shown], marker="." if shown.sum() < 40 else "")
    axes.set(xscale=scale, yscale=scale, xlabel=x_label, ylabel=y_label)


def _drawn(variables: Variables, name: str, largest: float | None = None) -> tuple[Array, str]:
    """Return the values of a variable and the label of their axis; `largest` decides the unit of lengths in metres."""
    _, values, about = variables[name]
    unit = str(about.get("units", "1"))
    largest = np.nanmax(np.abs(values), initial=0.0) if largest is None else largest
    unit, size = shown_unit(largest, unit)
    values, unit = values / size, unit.replace("um", "µm") if size < 1 else unit
    return values, _AXES.get(name, name) + ("" if unit == "1" else f" ({unit})")
