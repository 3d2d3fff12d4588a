"""Choose the colour of a Hurst exponent in all figures and on the page."""

from matplotlib import colormaps


def hurst_color(hurst):
    """Return the colour of a Hurst exponent as (red, green, blue, alpha), each from 0 to 1.

    The colours are those of viridis, which differ for any colour vision and in grey. The power 1.5 spreads the colours
    near H = 1.
    """
    return colormaps["viridis"](0.85 * hurst**1.5)
