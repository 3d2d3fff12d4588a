"""Loading curves of the surfaces of a batch by boundary elements."""

from viscorough.contact.loading_path import indent


def indent_realization(realization, indenter, *, tolerance, until_fraction, until_x, whole_curves, short_until_x=None):
    """Return the LoadingCurve of a surface up to a contact fraction or X = F/(4GhL), and this X.

    until_x : end of the first `whole_curves` realizations; the curves of others end at `short_until_x`. The number of a
        realization is independent of its surface, so the longer curves are a random sample of the ensemble.

    In X, h is the rms height over the disc or, if the disc is cut from a square, the larger value over disc and square.
    """
    until_x = until_x if realization.number < whole_curves else short_until_x
    rms = max(realization.rms[name] for name in ("disc", "square") if name in realization.rms)
    until_force = 4 * rms * realization.diameter * until_x
    return indent(indenter, tolerance=tolerance, until_fraction=until_fraction, until_force=until_force), until_x
