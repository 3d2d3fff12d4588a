"""Penetration of self-affine rough rigid indenters into a linearly viscous half-space.

The functions that most users need are here; each lives in the module that it is about.
"""

from importlib import import_module, metadata

__version__ = metadata.version("viscorough")

_HOME = {
    "Indenter": "indenter",
    "self_affine_disc": "surfaces",
    "self_affine_line": "surfaces",
    "LoadingCurve": "loading_curve",
    "ConvergenceError": "loading_curve",
    "AccuracyWarning": "loading_curve",
    "indent": "contact.loading_path",
    "reduce": "mdr",
    "kinetics": "viscous.correspondence",
    "penetration_law": "calibrated_law",
    "read_heights": "io.heights",
}
__all__ = sorted(_HOME)


def __getattr__(name):
    """Import on first use: the command line answers a typing error without loading the solvers."""
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
