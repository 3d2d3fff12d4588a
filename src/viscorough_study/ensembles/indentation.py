"""Loading curves of the surfaces of a batch by boundary elements."""

from viscorough.contact.loading_path import indent


def end_of_curve(number, indentation):
    """X at which the curve of a realization ends: `until_x` for the first `whole_curves`, `short_until_x` for others.

    number : of the realization; it is independent of the surface, so longer curves are a random sample of the ensemble
    """
    return indentation["until_x" if number < indentation["whole_curves"] else "short_until_x"]


def indent_surface(indenter, rms, diameter, *, tolerance, until_fraction, until_x):
    """LoadingCurve of a surface up to a contact fraction or X = F/(4GhL).

    rms : {convention: rms height}; diameter : L. In X, h is the rms height over the disc or, if the disc is cut from a
    square, the larger of those over disc and square.
    """
    until_force = 4 * max(rms[name] for name in ("disc", "square") if name in rms) * diameter * until_x
    return indent(indenter, tolerance=tolerance, until_fraction=until_fraction, until_force=until_force)
