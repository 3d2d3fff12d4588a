"""Figure 1 of the paper: an indenter for each Hurst exponent."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from viscorough_study.figures.style import MM, STYLE, WIDE

COLORS = "cividis_r"  # from bright to dark, with any colour vision and in grey


@rc_context(STYLE)
def plot_surfaces(examples):
    """Discs side by side, four in a row, all in one colour scale; darker is higher.

    examples : list of (Hurst exponent, heights over rms height of shape (rows, columns), spacing over diameter)
    """
    columns = min(4, len(examples))
    rows = -(-len(examples) // columns)
    figure = Figure(figsize=(WIDE * max(columns, 2) / 4, 47 * MM * rows + 15 * MM), layout="compressed")
    grid = figure.subplots(rows, columns, squeeze=False, sharey=True)
    for axes in grid.flat[len(examples) :]:
        axes.remove()
    limits = {
        "vmin": min(np.nanmin(heights) for _, heights, _ in examples),
        "vmax": max(np.nanmax(heights) for _, heights, _ in examples),
    }
    for axes, (hurst, heights, spacing) in zip(grid.flat, examples, strict=False):
        half = np.array(heights.shape) * spacing / 2
        extent = (-half[1], half[1], -half[0], half[0])
        image = axes.imshow(heights, cmap=COLORS, extent=extent, origin="lower", interpolation="nearest", **limits)
        axes.set(title=f"$H={hurst:g}$", xlabel="$x/L$", xticks=(-0.5, 0, 0.5), yticks=(-0.5, 0, 0.5))
    for axes in grid[:, 0]:
        axes.set_ylabel("$y/L$")
    panels = list(grid.flat[: len(examples)])
    bar = figure.colorbar(image, ax=panels, location="bottom", shrink=0.5, aspect=40, pad=0.03)
    bar.set_label("height$/h$ (darker is higher)")
    bar.ax.xaxis.set_major_locator(MaxNLocator(8, integer=True))
    return figure
