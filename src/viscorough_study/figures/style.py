"""What the figures share: style and sizes of the printed page, looks of the Hurst exponents, rows of fits, saving.

A Hurst exponent has its colour by its value, its marker and line style by its rank among the exponents shown:
figures of the same exponents agree, and exponents close to each other still differ.
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
    "pdf.fonttype": 42,  # TrueType: embedded, and text can be searched
}


@rc_context(STYLE)
def save_figure(figure, *paths):
    """Write a figure to each path, in the format of its suffix (.png, .pdf); each file appears whole or not at all.

    The same figure gives the same bytes. Raises ValueError for a path where no file can appear.
    """
    for path in paths:
        kind = Path(path).suffix[1:]
        with atomic_write(path) as temporary:
            figure.savefig(temporary, format=kind, metadata={"CreationDate": None} if kind == "pdf" else None)


def hurst_looks(exponents):
    """{Hurst exponent: color, marker, linestyle} of the exponents in ascending order."""
    markers, lines = "os^Dv<>p", ("-", (0, (6, 1.5)), (0, (6, 1, 1, 1)), (0, (1.5, 1)))
    return {
        hurst: {
            "color": colormaps["plasma"](0.8 * hurst),
            "marker": markers[rank % len(markers)],
            "linestyle": lines[rank % len(lines)],
        }
        for rank, hurst in enumerate(sorted(set(exponents)))
    }


def hurst_handles(looks, **common):
    """Handles of a legend of the Hurst exponents; common : what their looks are replaced or added to by."""
    return [Line2D([], [], **(look | common), label=f"$H={hurst:g}$") for hurst, look in looks.items()]


def mark(axes, x, y, interval, look, along="y"):
    """Marker at (x, y) on its interval (low, high) along x or y, which need not hold the marker; returns the marker."""
    middle, half = np.mean(interval), np.diff(interval) / 2
    at = (x, middle) if along == "y" else (middle, y)
    axes.errorbar(*at, **{f"{along}err": half}, fmt="none", ecolor=look["color"])
    return axes.plot(x, y, **look | {"linestyle": ""})[0]


def logarithmic_ticks(*axes):
    """Minor ticks for logarithmic axes, at the decades where not every decade has a major tick."""
    for axis in (axis for one in axes for axis in (one.xaxis, one.yaxis) if axis.get_scale() == "log"):
        decades = np.ptp(np.log10(axis.get_view_interval()))
        axis.set_major_locator(LogLocator(numticks=9))
        axis.set_minor_locator(LogLocator(subs=(1.0,) if decades > 8 else np.arange(2, 10), numticks=200))
        axis.set_minor_formatter(NullFormatter())


def plain_ticks(axis, ticks):
    """Ticks in plain numbers on a logarithmic axis of few decades, and minor ones between them."""
    axis.set(major_locator=FixedLocator(ticks), major_formatter="{x:g}")
    axis.set(minor_locator=LogLocator(subs=range(1, 10)), minor_formatter=NullFormatter())


def text_along(axes, x, y, text, **look):
    """Text from (x, y) on in the direction of a line of slope 1 in the logarithms."""
    angle = np.degrees(np.arctan2(y, x))  # of the line through the origin, which that is in plain numbers
    axes.text(x, y, text, rotation=angle, rotation_mode="anchor", transform_rotates_text=True, **look)
