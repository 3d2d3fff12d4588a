"""Penetration of self-affine rough rigid indenters into a linearly viscous half-space.

All that is public can be imported from here; exact solutions are in `viscorough.reference`. Each name is defined in the
module of its subject, which is imported when the name is first used.
"""

from importlib import import_module

_MODULE_OF = {
    "AccuracyWarning": "errors",
    "Contact": "contact_maps",
    "ConvergenceError": "errors",
    "CreepTable": "viscous.media",
    "ForceHistory": "viscous.correspondence",
    "IdentifiedMedium": "viscous.identification",
    "Indenter": "indenter",
    "KelvinVoigt": "viscous.media",
    "LoadingCurve": "loading_curve",
    "Maxwell": "viscous.media",
    "Medium": "viscous.medium",
    "Newtonian": "viscous.media",
    "Prony": "viscous.media",
    "SolverOptions": "contact.options",
    "Springpot": "viscous.media",
    "StandardLinearSolid": "viscous.media",
    "audit": "sum_rules",
    "complete_contact": "sum_rules",
    "contact_at": "contact.one_contact",
    "cut_disc": "surfaces",
    "estimate": "estimates",
    "force_under_depth": "viscous.relaxation",
    "identify_medium": "viscous.identification",
    "impulses": "viscous.correspondence",
    "indent": "contact.loading_path",
    "kinetics": "viscous.correspondence",
    "line_of_map": "mdr",
    "line_of_surface": "mdr",
    "load_curve": "io.saving",
    "march_events": "viscous.integration.events",
    "march_medium": "viscous.integration.internal_variables",
    "march_medium_events": "viscous.integration.internal_variable_events",
    "march_steps": "viscous.integration.stepping",
    "penetration_law": "calibrated_law",
    "plot": "plotting",
    "prepare": "preparation",
    "pressure_at": "viscous.pressures",
    "read_force_history": "io.motion",
    "read_heights": "io.heights",
    "read_line": "io.surfaces",
    "read_medium": "io.media",
    "reduce": "mdr",
    "save": "io.saving",
    "self_affine_disc": "surfaces",
    "self_affine_line": "surfaces",
}
__all__ = [*_MODULE_OF, "reference"]


def __getattr__(name: str) -> object:
    """Import on first use, so that the command line answers a typing error without loading the solvers."""
    if name == "__version__":
        from importlib.metadata import version

        return version("viscorough")
    if name == "reference":
        return import_module(f"{__name__}.{name}")
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE_OF[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__, "__version__"])
