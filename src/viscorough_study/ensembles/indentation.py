"""Compute the loading curve of a surface of an ensemble by boundary elements."""

from viscorough.contact.loading_path import indent


def indent_realization(realization, indenter, *, tolerance, until_x, whole=None, short_until_x=None):
    """Compute the loading curve of a surface up to a reduced force X; return (Realization, LoadingCurve).

    The returned Realization states this X as `until_x`. The curve ends at complete contact if that comes first.

    realization : labels of the surface; indenter : the surface
    tolerance : argument of viscorough.indent
    until_x : X at the end of the curves
    whole, short_until_x : only the first `whole` realizations have curves up to `until_x`, and the curves of all others
        end at `short_until_x`; by default all go on to `until_x`

    The number of a realization is independent of its surface, so the longer curves are a random sample of the ensemble.
    """
    is_whole = whole is None or realization.number < whole
    realization = realization._replace(until_x=until_x if is_whole else short_until_x)
    curve = indent(indenter, tolerance=tolerance, until_fraction=1.0, until_force=realization.until_force)
    return realization, curve
