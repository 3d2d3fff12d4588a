"""Compute the loading curve of a surface of an ensemble by boundary elements."""

from viscorough.contact.loading_path import indent


def indent_realization(realization, indenter, *, tolerance, until_fraction, until_x, whole_curves, short_until_x=None):
    """Compute the LoadingCurve of a surface up to a reduced force X = F/(4GhL); return the curve and this X.

    until_fraction : the curve ends earlier if it reaches this contact fraction
    until_x : X at the end of the curves of the first `whole_curves` realizations
    short_until_x : X at the end of the curves of all other realizations

    The number of a realization is independent of its surface, so the longer curves are a random sample of the ensemble.
    In X, h is the rms height over the disc. If the disc is cut from a square, h is the larger of the rms heights over
    the disc and over the square.
    """
    until_x = until_x if realization.number < whole_curves else short_until_x
    rms = max(realization.rms[name] for name in ("disc", "square") if name in realization.rms)
    until_force = 4 * rms * realization.diameter * until_x
    return indent(indenter, tolerance=tolerance, until_fraction=until_fraction, until_force=until_force), until_x
