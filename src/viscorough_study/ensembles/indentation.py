"""Compute the loading curves of the surfaces of a batch by boundary elements."""

from viscorough.contact.loading_path import indent


def indent_realization(realization, indenter, *, tolerance, until_fraction, until_x, whole_curves, short_until_x=None):
    """Return the LoadingCurve of a surface up to a contact fraction or an X = F/(4GhL), and this X.

    until_fraction : the curve ends at the latest at this contact fraction
    until_x : X at the end of the first `whole_curves` realizations; the curves of the other realizations end at
        `short_until_x`. The number of a realization is independent of its surface, so the longer curves are a random
        sample of the ensemble.

    h in X is the rms height over the disc. If the disc is cut from a square, h is the larger of the rms heights over
    disc and square.
    """
    until_x = until_x if realization.number < whole_curves else short_until_x
    rms = max(realization.rms[name] for name in ("disc", "square") if name in realization.rms)
    until_force = 4 * rms * realization.diameter * until_x
    return indent(indenter, tolerance=tolerance, until_fraction=until_fraction, until_force=until_force), until_x
