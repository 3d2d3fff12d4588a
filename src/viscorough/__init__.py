"""Penetration of self-affine rough rigid indenters into a linearly viscous half-space.

The functions and types that most users need can be imported from here. Each is defined in the module of its subject,
which is imported when the name is first used.
"""

from importlib import import_module

_MODULE_OF = {
    "Indenter": "indenter",
    "self_affine_disc": "surfaces",
    "self_affine_line": "surfaces",
    "LoadingCurve": "loading_curve",
    "ConvergenceError": "errors",
    "AccuracyWarning": "errors",
    "SolverOptions": "contact.options",
    "indent": "contact.loading_path",
    "Contact": "contact_maps",
    "contact_at": "contact.one_contact",
    "reduce": "mdr",
    "kinetics": "viscous.correspondence",
    "penetration_law": "calibrated_law",
    "estimate": "estimates",
    "read_heights": "io.heights",
    "prepare": "preparation",
}
__all__ = sorted(_MODULE_OF)


def __getattr__(name):
    """Import on first use, so that the command line answers a typing error without loading the solvers."""
    if name == "__version__":
        from importlib.metadata import version

        return version("viscorough")
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE_OF[name]}"), name)


def __dir__():
    return sorted([*globals(), *__all__, "__version__"])
