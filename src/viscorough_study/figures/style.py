"""Shared style of the figures: page sizes, colours, markers and line styles of series, ticks, saving.

The colour, marker and line style of a Hurst exponent depend on its value alone, so they agree in all figures.
Axis labels give units in parentheses after the symbol, and none for dimensionless quantities. No text is smaller than
`SMALL`.
"""

from functools import wraps
from itertools import cycle
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.style import context
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, MaxNLocator
from PIL import Image  # matplotlib depends on Pillow, so it is installed
from PIL.PngImagePlugin import PngInfo

from viscorough.io.atomic import atomic_write
from viscorough_study.run.hurst_colors import hurst_color
from viscorough_study.run.made_with import NAME, made_with, made_with_text, read_record
from viscorough_study.run.readable import readable

MM = 1 / 25.4
WIDE, NARROW = 170 * MM, 85 * MM  # widths of figures over two columns of a page, and over one column [inch]
SMALL = 7  # size of the smallest text [points]
DPI = 200  # resolution of PNG files [dots per inch]
FEW_DECADES = 2.1  # logarithmic axes that span fewer decades also have ticks between decades
# Largest root mean square of ln(vt/h) less a law with the exponent H/(1 + H), over region (b), for which the prefactor
# of this law describes the curve.
DEFINED = 0.1
GREY, PALE = "0.4", "0.8"
# The colours of Okabe and Ito, distinguishable with any colour vision.
BLACK, BLUE, SKY_BLUE, GREEN = "#000000", "#0072b2", "#56b4e9", "#009e73"
ORANGE, VERMILION, PURPLE = "#e69f00", "#d55e00", "#cc79a7"

SERIES_COLORS = (BLUE, VERMILION, GREEN, PURPLE, BLACK, SKY_BLUE, ORANGE)
SERIES_MARKERS = "osD^v<>ph*X"
HALO = {"path_effects": [withStroke(linewidth=2, foreground="white")]}  # of texts that may lie on lines
DASHED, DASH_DOTTED, DOTTED = (0, (6, 1.5)), (0, (6, 1, 1, 1)), (0, (1.5, 1))
# `hurst_looks` assigns these markers and line styles to the Hurst exponents 0, 0.6, 0.1, 0.7, ..., 0.5, in this order.
HURST_MARKERS = "X^o>P*vDs<p"
HURST_LINES = (DOTTED, DASH_DOTTED, "-", DASHED, DASHED, DOTTED, DASH_DOTTED, DOTTED, DASHED, "-", "-")

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": SMALL,
    "mathtext.fontset": "dejavusans",
    "axes.titlesize": 8,
    "axes.labelsize": 8,
    "figure.labelsize": 8,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.0,
    "lines.markersize": 4,
    "errorbar.capsize": 2,
    "legend.frameon": False,
    "legend.handlelength": 2.2,
    "legend.labelspacing": 0.3,
    "figure.constrained_layout.use": True,
    "pdf.fonttype": 42,  # embed TrueType fonts, so that the text can be searched
}


# A file matplotlibrc of the user, which would change figures unseen, is ignored.
in_style = context(["default", STYLE])


def figure(plot):
    """Decorate a function that draws a figure: apply `STYLE`, and set the ticks of logarithmic axes.

    If the first argument is a table without rows, the figure only says that the run has no data for it.
    """

    @wraps(plot)
    @in_style
    def styled(*arguments, **options):
        first = next(iter((*arguments, *options.values())))
        if isinstance(first, pd.DataFrame) and first.empty:
            return _without_data()
        drawn = plot(*arguments, **options)
        for axes in drawn.axes:
            axes.minorticks_off()
            for axis in (axes.xaxis, axes.yaxis):
                if axis.get_scale() == "log" and not isinstance(axis.get_major_locator(), FixedLocator):
                    _set_ticks(axis)
        return drawn

    return styled


def _without_data():
    """Return a figure that says that the run has no data for it, as with settings whose range no curve reaches."""
    empty = new_figure(20)
    empty.text(0.5, 0.5, "no data with these settings", ha="center", va="center", color=GREY)
    return empty


def new_figure(height, width=WIDE):
    """Return an empty figure; height in mm, width `WIDE` or `NARROW`."""
    return Figure(figsize=(width, height * MM))


def new_subplots(height, rows=1, columns=1, width=WIDE, **options):
    """Return a new figure and its axes.

    height, width : size of the figure, see `new_figure`; rows, columns, options : arguments of Figure.subplots
    """
    figure = new_figure(height, width)
    return figure, figure.subplots(rows, columns, **options)


def new_panels(count, columns, height, rest, *, xlabel="", ylabel="", **sharing):
    """Return a figure and a list of its `count` panels (axes), with `columns` panels in a row.

    height : height of a row of panels [mm]; rest : total height of titles, labels and legends [mm]
    xlabel : label of the lowest panel of each column; ylabel : label of the first panel of each row
    sharing : sharex and sharey of Figure.subplots
    """
    rows = -(-count // columns)
    figure, grid = new_subplots(height * rows + rest, rows, columns, squeeze=False, **sharing)
    for axes in grid[:, 0]:
        axes.set_ylabel(ylabel)
    for axes in grid.flat[count:]:
        axes.remove()
    panels = list(grid.flat[:count])
    for axes in panels[-columns:]:
        axes.tick_params(labelbottom=True)
        axes.set_xlabel(xlabel)
    return figure, panels


@in_style
def save_figure(figure, path):
    """Write a figure to a file; the suffix of the path (.png or .pdf) determines the format of the file.

    The file is written atomically and states the record of the job (run.made_with). The same figure gives the same
    bytes. A new PNG file removes a PDF file of an earlier job: see `_remove_outdated_pdf`.
    Raises ValueError for another suffix, and for a path that cannot be written.
    """
    if (suffix := Path(path).suffix) not in _WRITERS:
        raise ValueError(f"{path}: unknown kind of figure; allowed: {', '.join(_WRITERS)}")
    figure.set_dpi(DPI)
    with atomic_write(path) as temporary:
        _WRITERS[suffix](figure, temporary)
    if suffix == ".png":
        _remove_outdated_pdf(Path(path).with_suffix(".pdf"))


def _remove_outdated_pdf(pdf):
    """Remove the PDF file of a figure whose PNG file was made again, since only a request makes a PDF file.

    A PDF file with the record of this job is kept if it is newer than the inputs of the job: both files were then
    requested at the same time.
    """
    if pdf.is_file():
        own = made_with().get(NAME, {"inputs": []})
        is_newer = all(pdf.stat().st_mtime_ns > Path(file).stat().st_mtime_ns for file in own["inputs"])
        if not (is_newer and read_record(pdf) == own):
            pdf.unlink()


def _write_pdf(figure, path):
    from matplotlib.backends.backend_pdf import FigureCanvasPdf  # this import takes long, and PDF files are rare

    # Figure.savefig is not used, because it would draw everything twice.
    FigureCanvasPdf(figure).print_pdf(path, metadata={"CreationDate": None, "Subject": made_with_text().get(NAME)})


def _write_png(figure, path):
    """Write a PNG file, with at most 256 colours if the figure has no colour map.

    Fewer colours make a file a third as large, and the page of results embeds all figures. With fewer colours than the
    colour map has, however, readers would read wrong values off its bar.
    """
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    picture = Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3])
    if not any(axes.images for axes in figure.axes):
        picture = picture.quantize(256, dither=Image.Dither.NONE)
    texts = PngInfo()
    for name, text in made_with_text().items():
        texts.add_text(name, text)
    picture.save(path, format="png", dpi=(DPI, DPI), optimize=True, pnginfo=texts)


_WRITERS = {".png": _write_png, ".pdf": _write_pdf}


def hurst_looks(exponents):
    """Return {Hurst exponent: line properties}, by ascending exponent; the properties are color, marker, linestyle."""
    looks = {}
    for hurst in sorted(set(exponents)):
        # The ranks, and therefore the markers, of all multiples of 0.1 are different. Neighbouring exponents also have
        # different markers.
        rank, color = round(20 * hurst) % len(HURST_MARKERS), hurst_color(hurst)
        looks[hurst] = {"color": color, "marker": HURST_MARKERS[rank], "linestyle": HURST_LINES[rank]}
    return looks


def series_looks(names):
    """Return {name: line properties}, in the order of the names; no two names share both color and marker."""
    looks = zip(dict.fromkeys(names), cycle(SERIES_COLORS), cycle(SERIES_MARKERS), strict=False)
    return {name: {"color": color, "marker": marker} for name, color, marker in looks}


def count_text(counts):
    """Return the smallest and the largest count as text, such as "6 to 54", or "6" if all counts are equal."""
    low, high = min(counts), max(counts)
    return f"{low:g}" if low == high else f"{low:g} to {high:g}"


def realizations_text(ensembles):
    """Return the smallest and the largest number of averaged realizations as text, such as "6 to 54".

    The smallest number is the number of curves that were computed up to the largest X.
    """
    counts = []
    for ensemble in ensembles:
        until_x = np.broadcast_to(ensemble["until_x"].values, ensemble.sizes["realization"])
        counts += [until_x.size, int((until_x == until_x.max()).sum())]
    return count_text(counts)


def handle(label, **look):
    """Return a legend entry for a line or a marker; look : line properties"""
    return Line2D([], [], label=label, **look)


def hurst_handles(looks, **changes):
    """Return a legend entry for each Hurst exponent.

    looks : {Hurst exponent: line properties}; changes : line properties of all entries, which override `looks`
    """
    return [handle(f"$H={hurst:g}$", **(look | changes)) for hurst, look in looks.items()]


def label_ends(axes, ends, gap):
    """Write labels right of the axes, and join each by a thin line to the end of its curve.

    Labels are at the heights of the ends, or moved apart. Call this function last: the limits of the axes are kept.

    ends : list of (label, x, y, color)
    gap : least distance of two labels, as a share of the height of the axes
    """
    axes.autoscale(False)
    to_share = axes.transScale + axes.transLimits
    heights = np.array([to_share.transform((x, y))[1] for _, x, y, _ in ends])
    order, steps = np.argsort(heights, kind="stable"), gap * np.arange(len(ends))
    # Move labels only up, or only down, until they are apart; the mean of both moves them least.
    upward = np.maximum.accumulate(heights[order] - steps) + steps
    downward = np.minimum.accumulate((heights[order] - steps)[::-1])[::-1] + steps
    for place, height in zip(order, (upward + downward) / 2, strict=True):
        label, x, y, color = ends[place]
        arrow = {"arrowstyle": "-", "linewidth": 0.4, "color": color, "shrinkA": 1, "shrinkB": 2}
        arrow["relpos"] = (0, 0.5)  # it begins at the left end of the label
        look = {"textcoords": "axes fraction", "color": color, "va": "center", "arrowprops": arrow}
        axes.annotate(label, (x, y), (1.06, height), **look)


def draw_band(axes, rows, name, color, alpha=0.15):
    """Fill the band between the columns `name`_low and `name`_high, drawn against the column x of the table rows."""
    axes.fill_between(rows["x"], rows[f"{name}_low"], rows[f"{name}_high"], color=color, alpha=alpha, linewidth=0)


def mark_with_interval(axes, x, y, interval, look, along="y"):
    """Draw a marker at (x, y), and an interval (low, high) along x or y; the marker may lie outside the interval."""
    middle, half = np.mean(interval), np.diff(interval) / 2
    center = (x, middle) if along == "y" else (middle, y)
    axes.errorbar(*center, **{f"{along}err": half}, fmt="none", ecolor=look["color"])
    axes.plot(x, y, **look | {"linestyle": ""})


def _set_ticks(axis):
    """Set the ticks of a logarithmic axis.

    Ticks are at decades, and on an axis of few decades also at 2 and 5 times each decade. An axis of less than one
    decade has evenly spaced ticks. There are no minor ticks.
    """
    decades = np.ptp(np.log10(axis.get_view_interval()))
    axis.set_major_locator(LogLocator(numticks=9))
    if decades < FEW_DECADES:
        evenly = MaxNLocator(6, steps=(1, 2, 5, 10))
        axis.set_major_locator(evenly if decades < 1 else LogLocator(subs=(1.0, 2.0, 5.0), numticks=20))
        axis.set_major_formatter(FuncFormatter(lambda value, _: readable(value)))
