"""Draw Figure 1 of the paper: one indenter for each Hurst exponent."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LightSource, Normalize

from viscorough_study.figures import style

COLORS = "viridis"  # the colours of viscorough plot: brighter is higher
LIMIT = 2.5  # the colours end at this height above and below the mean, in rms heights
RELIEF = 0.18  # brightness that a slope of the rms value adds or takes


@style.figure
def plot_surfaces(examples):
    """Draw discs side by side, four in a row, all in one colour scale, with light from the upper left.

    examples : list of (Hurst exponent, heights in units of the rms height, spacing in units of the diameter); heights
        have the shape (rows, columns)
    """
    columns = min(4, len(examples))
    figure, panels = style.new_panels(len(examples), columns, height=47, rest=15, ylabel="$y/L$", sharey=True)
    figure.set(figwidth=style.WIDE * max(columns, 2) / 4, layout_engine="compressed")
    colors = ScalarMappable(Normalize(-LIMIT, LIMIT), COLORS)
    for axes, (hurst, heights, spacing) in zip(panels, examples, strict=True):
        half = np.array(heights.shape) * spacing / 2
        extent = (-half[1], half[1], -half[0], half[0])
        axes.imshow(_relief(heights, colors), extent=extent, origin="lower", interpolation="nearest")
        axes.set(title=f"$H={hurst:g}$", xlabel="$x/L$", xticks=(-0.5, 0, 0.5), yticks=(-0.5, 0, 0.5))
    bar = figure.colorbar(colors, ax=panels, location="bottom", shrink=0.5, aspect=40, pad=0.03, extend="both")
    bar.set_label("height$/h$ (brighter is higher)")
    return figure


def _relief(heights, colors):
    """Return an image of heights, shape (rows, columns, 4): colours, brighter on slopes that face the upper left."""
    upward, rightward = np.gradient(heights)  # rows are drawn from bottom to top
    slope = rightward - upward
    light = np.clip(0.5 + RELIEF * slope / np.sqrt(np.nanmean(slope**2)), 0, 1)
    image = colors.to_rgba(heights)
    image[..., :3] = LightSource().blend_soft_light(image[..., :3], np.nan_to_num(light, nan=0.5)[..., None])
    image[np.isnan(heights)] = 0  # transparent
    return image
