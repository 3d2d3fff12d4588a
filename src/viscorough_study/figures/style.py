"""What the figures share: style and sizes of the printed page, colours, looks of Hurst exponents, ticks, saving.

The colour of a Hurst exponent depends on its value, its marker and line style on its rank among the exponents drawn:
figures of the same exponents agree, and exponents close to each other can still be told apart.
"""

from pathlib import Path

import numpy as np
from matplotlib import colormaps, rc_context
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, LogLocator, NullFormatter

from viscorough.io.atomic import atomic_write

MM = 1 / 25.4
WIDE, NARROW = 180 * MM, 120 * MM  # across two columns of a page, and a little more than one
GREY, PALE = "0.4", "0.8"
# The colours of Okabe and Ito, which can be told apart with any colour vision.
BLACK, BLUE, SKY_BLUE, GREEN = "#000000", "#0072b2", "#56b4e9", "#009e73"
ORANGE, VERMILION, PURPLE, YELLOW = "#e69f00", "#d55e00", "#cc79a7", "#f0e442"

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "mathtext.fontset": "dejavusans",
    "axes.titlesize": 8,
    "axes.labelsize": 8,
    "axes.linewidth": 0.6,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "xtick.minor.visible": True,
    "ytick.minor.visible": True,
    "lines.linewidth": 1.0,
    "lines.markersize": 4,
    "errorbar.capsize": 2,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "legend.handlelength": 2.2,
    "legend.labelspacing": 0.3,
    "figure.constrained_layout.use": True,
    "savefig.dpi": 200,
    "pdf.fonttype": 42,  # TrueType: embedded, and the text can be searched
}


@rc_context(STYLE)
def save_figure(figure, *paths):
    """Write a figure atomically to each path, in the format of its suffix (.png, .pdf).

    The same figure gives the same bytes. Raises ValueError for a path that cannot be written.
    """
    for path in paths:
        kind = Path(path).suffix[1:]
        with atomic_write(path) as temporary:
            figure.savefig(temporary, format=kind, metadata={"CreationDate": None} if kind == "pdf" else None)


def require_rows(function, table):
    """Raise ValueError, which names the plotting function, for a table without rows."""
    if table.empty:
        raise ValueError(f"{function}: the table has no rows; at least one is needed")


def hurst_looks(exponents):
    """{Hurst exponent: color, marker, linestyle}, by ascending exponent."""
    markers, lines = "os^Dv<>p", ("-", (0, (6, 1.5)), (0, (6, 1, 1, 1)), (0, (1.5, 1)))
    return {
        hurst: {
            "color": colormaps["plasma"](0.8 * hurst),
            "marker": markers[rank % len(markers)],
            "linestyle": lines[rank % len(lines)],
        }
        for rank, hurst in enumerate(sorted(set(exponents)))
    }


def hurst_handles(looks, **changes):
    """Legend handles of the Hurst exponents; changes : line properties that replace those of their looks."""
    return [Line2D([], [], **(look | changes), label=f"$H={hurst:g}$") for hurst, look in looks.items()]


def mark_with_interval(axes, x, y, interval, look, along="y"):
    """Marker at (x, y) and its interval (low, high) along x or y, which need not contain it; returns the marker."""
    middle, half = np.mean(interval), np.diff(interval) / 2
    center = (x, middle) if along == "y" else (middle, y)
    axes.errorbar(*center, **{f"{along}err": half}, fmt="none", ecolor=look["color"])
    return axes.plot(x, y, **look | {"linestyle": ""})[0]


def logarithmic_ticks(*panels):
    """Minor ticks on logarithmic axes: at the decades where not every decade has a major tick, else between them."""
    for axis in (axis for axes in panels for axis in (axes.xaxis, axes.yaxis) if axis.get_scale() == "log"):
        decades = np.ptp(np.log10(axis.get_view_interval()))
        axis.set_major_locator(LogLocator(numticks=9))
        axis.set_minor_locator(LogLocator(subs=(1.0,) if decades > 8 else np.arange(2, 10), numticks=200))
        axis.set_minor_formatter(NullFormatter())


def plain_ticks(axis, ticks):
    """Major ticks labelled with plain numbers on a logarithmic axis of few decades, and minor ticks between them."""
    axis.set(major_locator=FixedLocator(ticks), major_formatter="{x:g}")
    axis.set(minor_locator=LogLocator(subs=range(1, 10)), minor_formatter=NullFormatter())
