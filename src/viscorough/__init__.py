"""Compute the penetration of self-affine rough rigid indenters into a linearly viscous half-space.

All public names can be imported from here; exact solutions are in `viscorough.reference`. Each name is defined in
another module of the package, which is imported when the name is first used.
"""

import re
from importlib import import_module
from pathlib import Path

# The stub file __init__.pyi lists each public name with its module. Type checkers read it, too.
_STUB = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
_MODULE_OF = {name: module for module, name in re.findall(r"^from viscorough\.(\S+) import (\w+)", _STUB, re.MULTILINE)}
__all__ = [*_MODULE_OF, "reference"]


def __getattr__(name: str) -> object:
    """Import a public name when it is first used.

    The command line can therefore report a typing error without loading the solvers.
    """
    if name == "__version__":
        from importlib.metadata import version

        return version("viscorough")
    if name == "reference":
        return import_module(f"{__name__}.{name}")
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE_OF[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
