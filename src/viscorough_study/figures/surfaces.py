"""Draw Figure 1 of the paper: one indenter for each Hurst exponent."""

import numpy as np
from matplotlib.ticker import MaxNLocator

from viscorough_study.figures import style

COLORS = "cividis_r"  # colours from bright to dark, which suit any colour vision and greyscale


@style.figure
def plot_surfaces(examples):
    """Draw discs side by side, four in a row, all in one colour scale; darker is higher.

    examples : list of (Hurst exponent, heights in units of the rms height, spacing in units of the diameter); heights
        have the shape (rows, columns)
    """
    columns = min(4, len(examples))
    figure, panels = style.new_panels(len(examples), columns, height=47, rest=15, ylabel="$y/L$", sharey=True)
    figure.set(figwidth=style.WIDE * max(columns, 2) / 4, layout_engine="compressed")
    all_heights = np.concatenate([heights.ravel() for _, heights, _ in examples])
    limits = {"vmin": np.nanmin(all_heights), "vmax": np.nanmax(all_heights)}
    for axes, (hurst, heights, spacing) in zip(panels, examples, strict=True):
        half = np.array(heights.shape) * spacing / 2
        extent = (-half[1], half[1], -half[0], half[0])
        image = axes.imshow(heights, cmap=COLORS, extent=extent, origin="lower", interpolation="nearest", **limits)
        axes.set(title=f"$H={hurst:g}$", xlabel="$x/L$", xticks=(-0.5, 0, 0.5), yticks=(-0.5, 0, 0.5))
    bar = figure.colorbar(image, ax=panels, location="bottom", shrink=0.5, aspect=40, pad=0.03)
    bar.set_label("height$/h$, on one scale for all discs (darker is higher)")
    bar.ax.xaxis.set_major_locator(MaxNLocator(8, integer=True))
    return figure
