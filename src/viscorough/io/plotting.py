"""Draw results: surfaces, fields of a contact, loading curves, motions, estimates.

Only this module of the library imports matplotlib.
"""

import re
from collections.abc import Callable
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from viscorough.basics import units
from viscorough.basics.summaries import with_unit
from viscorough.basics.types import Array, FilePath
from viscorough.io.atomic import atomic_write
from viscorough.io.curves import STORED, curve_from_content, unstack_curves
from viscorough.io.netcdf import Content, Variable
from viscorough.io.saving import Result, to_content
from viscorough.io.suffixes import FIGURES, check_suffix

Variables = dict[str, Variable]
# Metadata of figures have no dates, so that the same result gives the same file.
_METADATA: dict[str, Any] = {".png": {}, ".pdf": {"CreationDate": None}, ".svg": {"Date": None}}
# Colours of Okabe and Ito, which people with any colour vision can distinguish.
_BLUE, _VERMILION = "#0072b2", "#d55e00"
# A curve of fewer points than this is drawn with a marker at each point.
_FEW = 40
# If the ratio of the ends of a logarithmic axis is smaller than this, ticks at powers of ten only would be too few.
_FEW_DECADES = 80
# Colours end at this percentile of the pressures in contact, since single elements may have far larger pressures.
_PERCENTILE = 99
# At most this many contacts of a file are drawn.
_MOST_MAPS = 4
_STYLE: dict[Any, Any] = {"font.size": 8, "axes.titlesize": 8, "lines.linewidth": 1.2, "lines.markersize": 3}
_STYLE |= {"savefig.dpi": 200, "svg.hashsalt": "viscorough"}
_COLOURS = {"heights": "cividis", "gap": "cividis", "pressure": "inferno"}
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_SYMBOLS = {
    "depth": "u",
    "force": "F/G",
    "stiffness": "k/G",
    "pressure": "p/G",
    "time": "t",
    "velocity": "v",
}
# Labels of axes: {name of the variable: label}.
_LABELS = {name: f"{name.replace('_', ' ')} ${symbol}$" for name, symbol in _SYMBOLS.items()}
_LABELS |= {"contact_fraction": "contact fraction", "heights": "height $z$", "x": "$x$", "y": "$y$"}
_LABELS |= {"normal_force": "force $F$", "normal_stiffness": "stiffness $k$", "normal_pressure": "pressure $p$"}
# Numbers in the text above the maps of a contact: {name of the number: label in the text}.
_STATE = {"depth": "$u$", "force": "$F/G$", "normal_force": "$F$", "largest_normal_pressure": "largest $p$"}
_STATE |= {"contact_fraction": "contact fraction", "corrected_contact_area": "corrected contact area"}
_STATE |= {"patches": "patches"}
_PRESSURES = ("normal_pressure", "mean_normal_pressure", "largest_normal_pressure")
_AREAS = ("contact_area", "corrected_contact_area")


def plot(result: Content | Result, path: FilePath | None = None) -> Figure:
    """Draw a result: heights, fields of a contact, a loading curve, a motion, or an estimate.

    Parameters
    ----------
    result : Content or Indenter or LoadingCurve or Contact or Motion or Estimate
        Result of the library, or the io.netcdf.Content of a file. Needs matplotlib: pip install "viscorough[plot]".
    path : path, optional
        File to write atomically (.png, .pdf or .svg). The same result gives the same bytes. By default no file is
        written.

    Returns
    -------
    Figure
        Figure of matplotlib. Maps have the first row at the top. Coordinates are taken from the file, or are 0 at the
        centre. Colours of pressures end at the 99th percentile.

    Raises
    ------
    ValueError
        For a suffix that is not allowed, and for a Content that holds none of these results.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, seed=1)
    >>> figure = viscorough.plot(viscorough.indent(disc))
    >>> [axes.get_title() for axes in figure.axes]
    ['force', 'stiffness', 'contact fraction']
    """
    suffix = "" if path is None else check_suffix(path, FIGURES)
    with mpl.rc_context(_STYLE):
        draw, numbers = kind_of(result if isinstance(result, Content) else to_content(result))
        figure = draw(numbers)
        if path is not None:
            with atomic_write(path) as temporary:
                figure.savefig(temporary, format=suffix[1:], metadata=_METADATA[suffix])
    return figure


def kind_of(content: Content) -> tuple[Callable[[Variables], Figure], Variables]:
    """Choose the function that draws a Content. Return the function and its argument, the variables that hold numbers.

    Raises ValueError for a Content that no function can draw.
    """
    # Check a loading curve before it is drawn: the conversion to a LoadingCurve raises ValueError if its numbers
    # contradict each other. The result of the conversion is not used.
    if set(STORED) <= set(content.variables):
        (unstack_curves if "levels" in content.variables else curve_from_content)(content)
    numbers = {name: v for name, v in content.variables.items() if v.values.dtype.kind in "iuf" and v.values.size}
    dimensions = {name: variable.dimensions for name, variable in numbers.items()}
    for draw, needed in _KINDS:
        if needed.items() <= dimensions.items():
            return draw, numbers
    raise ValueError(
        "no surface, fields of a contact, loading curve or motion in it; a file that viscorough wrote is needed"
    )


# ---- maps


def _surface(variables: Variables) -> Figure:
    values = variables["heights"].values
    if values.ndim == 1:
        figure, (axes,) = _panels(1)
        axes.plot(variables["x"].values, values, color=_BLUE, linewidth=0.6)
        _label(axes, variables, "x", "heights", "heights")
        return figure
    variables = _in_readable_units(variables)
    figure, (axes,) = _panels(1, width=4.6, height=3.8)
    _map(figure, axes, variables, "heights", variables["heights"].values)
    return figure


def _fields(variables: Variables) -> Figure:
    variables = _in_readable_units(variables)
    pressure = _with_modulus(variables, "pressure")
    names = [name for name in (pressure, "gap", "contact") if name in variables]
    stacks = {name: variables[name].values.reshape(-1, *variables[name].values.shape[-2:]) for name in names}
    outside = np.isnan(stacks[pressure])
    contacts = min(len(stacks[pressure]), _MOST_MAPS)
    figure = Figure(figsize=(3.1 * len(names), 2.7 * contacts), layout="constrained")
    for i, part in enumerate(figure.subfigures(contacts, 1, squeeze=False)[:, 0]):
        part.suptitle(_state(variables, i), fontsize=mpl.rcParams["axes.titlesize"])
        for axes, name in zip(part.subplots(1, len(names), squeeze=False)[0], names, strict=True):
            _map(part, axes, variables, name, np.where(outside[i], np.nan, stacks[name][i].astype(float)))
    return figure


def _with_modulus(variables: Variables, name: str) -> str:
    """Return the name of the variable in N, N/m or Pa, such as normal_force, if it exists; otherwise `name`."""
    return f"normal_{name}" if f"normal_{name}" in variables else name


def _in_readable_units(variables: Variables) -> Variables:
    """Convert positions, gap, heights and depth to units that suit their size, pressures to MPa and areas to um2.

    Positions along x and y get the same unit. Quantities whose unit of length is not known are not changed.
    """
    changed = dict(variables)
    for names, unit in ((_PRESSURES, "MPa"), (_AREAS, "um2")):
        for name in names:
            if (stated := _stated_unit(variables, name)) != "1":
                values = variables[name].values * units.factor(stated, unit)
                changed[name] = variables[name]._replace(values=values, attributes={"units": unit})
    for names in (("x", "y"), ("gap",), ("heights",), ("depth",)):
        with_units = [name for name in names if _stated_unit(variables, name) != "1"]
        largest = max((np.nanmax(np.abs(variables[name].values)) for name in with_units), default=0)
        if len({variables[name].attributes["units"] for name in with_units}) != 1 or not 0 < largest < np.inf:
            continue
        stated = variables[with_units[0]].attributes["units"]
        metres = units.metres(stated)
        unit = next((unit for unit in ("m", "mm", "um") if largest * metres >= 2 * units.metres(unit)), "nm")
        for name in with_units:
            values = variables[name].values * units.factor(stated, unit)
            changed[name] = variables[name]._replace(values=values, attributes={"units": unit})
    return changed


def _stated_unit(variables: Variables, name: str) -> str:
    """Return the unit of a variable as its file states it; "1" if the variable or its unit is missing."""
    return str(variables[name].attributes.get("units", "1")) if name in variables else "1"


def _state(variables: Variables, index: int) -> str:
    """Return a text with the main numbers of one contact; the force is F if the shear modulus was given, else F/G.

    index : number of the contact, from 0
    """
    texts = []
    for name, symbol in _STATE.items():
        if name in variables and variables[name].values.size > index and _with_modulus(variables, name) == name:
            texts.append(f"{symbol} {with_unit(variables[name].values.flat[index], _unit(variables[name]))}")
    return ", ".join(texts)


def _map(figure: Figure, axes: Axes, variables: Variables, name: str, values: Array) -> None:
    """Draw a map, grey outside the indenter, with a colour bar unless the map shows which elements are in contact."""
    extent: list[float] = []
    for position in (variables["x"].values, variables["y"].values):
        step = (position[-1] - position[0]) / max(len(position) - 1, 1) or 1.0
        extent += [position[0] - step / 2, position[-1] + step / 2]
    left, right, top, bottom = extent  # the first row is at the top
    look: dict[str, Any] = {"extent": [left, right, bottom, top], "cmap": _COLOURS.get(name.removeprefix("normal_"))}
    title = name.removeprefix("normal_")
    if name == "contact":
        look |= {"cmap": mpl.colors.ListedColormap(["white", _VERMILION]), "vmin": 0, "vmax": 1}
    if title == "pressure" and (values > 0).any():
        look["vmax"] = np.percentile(values[values > 0], _PERCENTILE)
        title += f", colours to the {_PERCENTILE}th percentile"
    image = axes.imshow(values, origin="upper", **look)
    axes.set_facecolor("0.85")
    if name != "contact":
        extend = "max" if title.startswith("pressure") else "neither"
        figure.colorbar(image, ax=axes, label=_label_of(variables, name), shrink=0.85, extend=extend)
    _label(axes, variables, "x", "y", title)


# ---- curves


def _motion(variables: Variables) -> Figure:
    """Draw depth and velocity against time. If force or depth decreases, call `_loop` instead."""
    time = variables["time"].values
    if not (np.diff(time) >= 0).all():
        raise ValueError("time must not decrease; a file that viscorough wrote is needed")
    along = variables["time"].dimensions
    here = {name: variable for name, variable in variables.items() if variable.dimensions == along}
    if "force" in here and any((np.diff(here[name].values) < 0).any() for name in ("depth", "force")):
        return _loop(here)
    names = [name for name in ("depth", "velocity") if name in here]
    figure, axes = _panels(len(names))
    for panel, name in zip(axes, names, strict=True):
        _curve(panel, time, variables[name].values)
        _label(panel, variables, "time", name, name)
    return figure


def _loop(variables: Variables) -> Figure:
    """Draw depth and force against time, and force against depth, on linear axes."""
    # The force of a motion is F. The name normal_force gives it the label F; the name force would give the label F/G.
    variables = variables | {"normal_force": variables["force"]}
    pairs = [
        ("time", "depth", "depth"),
        ("time", "normal_force", "force"),
        ("depth", "normal_force", "force-depth loop"),
    ]
    figure, axes = _panels(len(pairs))
    for panel, (x, y, title) in zip(axes, pairs, strict=True):
        marker = "o" if variables[x].values.size < _FEW else ""
        panel.plot(variables[x].values, variables[y].values, color=_BLUE, marker=marker)
        _label(panel, variables, x, y, title)
    return figure


def _loading_curve(variables: Variables) -> Figure:
    dimensions = variables["depth"].values.ndim
    force, stiffness = (_with_modulus(variables, name) for name in ("force", "stiffness"))
    pairs = [("depth", force), (force, stiffness), (force, "contact_fraction")]
    pairs = [pair for pair in pairs if pair[1] in variables and variables[pair[1]].values.ndim == dimensions]
    figure, axes = _panels(len(pairs))
    for panel, (x, y) in zip(axes, pairs, strict=True):
        for along, over in zip(*(np.atleast_2d(variables[name].values) for name in (x, y)), strict=True):
            _curve(panel, along, over, thin=dimensions == 2)
        _label(panel, variables, x, y, y.removeprefix("normal_"))
    return figure


def _panels(count: int, width: float = 3.1, height: float = 2.7) -> tuple[Figure, Any]:
    figure = Figure(figsize=(width * count, height), layout="constrained")
    return figure, figure.subplots(1, count, squeeze=False)[0]


def _curve(axes: Axes, x: Array, y: Array, thin: bool = False) -> None:
    """Draw the positive values of a curve on logarithmic axes.

    thin : True for a thin, transparent line, if many curves share the axes
    """
    shown = (x > 0) & (y > 0)
    axes.set(xscale="log", yscale="log")
    # Labels of minor ticks are empty but would take room.
    axes.tick_params(which="minor", labelbottom=False, labelleft=False)
    look = {"linewidth": 0.5, "alpha": 0.5} if thin else {"marker": "o" if shown.sum() < _FEW else ""}
    axes.plot(x[shown], y[shown], color=_BLUE, **look)


def _label(axes: Axes, variables: Variables, x: str, y: str, title: str) -> None:
    axes.set(xlabel=_label_of(variables, x), ylabel=_label_of(variables, y), title=title.replace("_", " "))
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        # Add ticks at 2 and 5 times the powers of ten.
        if axis.get_scale() == "log" and high < _FEW_DECADES * low:
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=20))
            axis.set_major_formatter("{x:.3g}")


def _label_of(variables: Variables, name: str) -> str:
    unit = _unit(variables[name])
    return f"{_LABELS.get(name, name)}{'' if unit == '1' else f' ({unit})'}"


def _unit(variable: Variable) -> str:
    """Return the unit of a variable in common spelling, such as µm², µm/s or N/m; "1" without a unit."""
    unit = str(variable.attributes.get("units") or "1").replace("um", "µm")
    unit = re.sub(r"(?<=[^\W\d])-?\d", lambda power: power[0].translate(_SUPERSCRIPTS), unit)
    return re.sub(r" (s|m)⁻¹", r"/\1", unit)


_X = {"x": ("x",)}
_XY = _X | {"y": ("y",)}
# Functions that draw figures, each with the variables that it needs: (function, {name of the variable: dimensions}).
# `kind_of` chooses the first function whose variables are all in the file.
_KINDS: tuple[tuple[Callable[[Variables], Figure], dict[str, tuple[str, ...]]], ...] = (
    (_fields, {"pressure": ("y", "x"), **_XY}),
    (_fields, {"pressure": ("level", "y", "x"), **_XY}),
    (_surface, {"heights": ("y", "x"), **_XY}),
    (_surface, {"heights": ("x",), **_X}),
    (_motion, {"time": ("level",), "depth": ("level",)}),
    (_loading_curve, {"depth": ("level",), "force": ("level",)}),
    (_loading_curve, {"depth": ("realization", "level"), "force": ("realization", "level")}),
)
