"""Write numbers as text for readers of the results page and the figures."""

import numpy as np


def readable(value, *, power=False):
    """Return a number as text with three digits, such as 0.397, 51433, 1.2×10⁻⁵; a dash for None and nan.

    power : True to write a power of ten in any case, so that numbers next to each other are written alike
    """
    if value is None or np.isnan(value):
        return "–"
    if np.isinf(value):
        return "∞"
    value = float(f"{value:.12g}")  # a quotient such as 100000.00000000001 is meant to be an integer
    if not power and value == round(value) and abs(value) < 1e6:
        return f"{value:.0f}".replace("-", "−")
    if not power and 1e-3 <= abs(value) < 1e4:
        return (f"{value:.0f}" if abs(value) >= 1e3 else f"{value:.3g}").replace("-", "−")
    mantissa, exponent = f"{value:.1e}".split("e")
    superscript = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{mantissa.removesuffix('.0')}×10{superscript}".replace("-", "−")
