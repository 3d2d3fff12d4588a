"""Figure 1 of the paper: an indenter for each Hurst exponent."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from viscorough_study.figures.style import MM, STYLE, WIDE


@rc_context(STYLE)
def plot_surfaces(examples):
    """Discs side by side, four in a row; darker is higher, and each grey scale spans the heights of its disc.

    examples : list of (Hurst exponent, heights over rms height of shape (rows, columns), spacing over diameter)
    """
    columns = min(4, len(examples))
    rows = -(-len(examples) // columns)
    figure = Figure(figsize=(WIDE * columns / 4, 64 * MM * rows), layout="compressed")
    grid = figure.subplots(rows, columns, squeeze=False, sharey=True)
    for axes in grid.flat[len(examples) :]:
        axes.remove()
    for axes, (hurst, heights, spacing) in zip(grid.flat, examples, strict=False):
        half = np.array(heights.shape) * spacing / 2
        extent = (-half[1], half[1], -half[0], half[0])
        image = axes.imshow(heights, cmap="Greys", extent=extent, origin="lower", interpolation="nearest")
        axes.set(title=f"$H={hurst:g}$", xlabel="$x/L$", xticks=(-0.5, 0, 0.5), yticks=(-0.5, 0, 0.5))
        bar = figure.colorbar(image, ax=axes, location="bottom", shrink=0.9, aspect=14, label="height$/h$")
        bar.ax.xaxis.set_major_locator(MaxNLocator(4, integer=True))
    for axes in grid[:, 0]:
        axes.set_ylabel("$y/L$")
    return figure
