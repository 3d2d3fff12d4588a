"""Format numbers and units for the short texts about results that print() and notebooks show."""

import contextlib
import io
import re
from importlib import import_module
from typing import Any


class InNotebooks:
    """Result that notebooks show as a small table of its text, beside its plot if matplotlib is installed."""

    def _repr_html_(self: Any) -> str:
        import base64  # imported here, so that the command line starts faster
        import html

        title, *lines = str(self).splitlines()
        entries = (re.split(r" (?=[-\d])", entry, maxsplit=1) for line in lines for entry in line.split(", "))
        cells = ("".join(f"<td>{html.escape(cell)}</td>" for cell in entry) for entry in entries)
        table = "".join(f"<tr>{row}</tr>" for row in cells)
        picture = io.BytesIO()
        with contextlib.suppress(ModuleNotFoundError):
            # By its name: plots are in a layer above this one, and results do not depend on what a notebook shows.
            import_module("viscorough").plot(self).savefig(picture, format="png", dpi=80)
        source = f"data:image/png;base64,{base64.b64encode(picture.getvalue()).decode()}"
        image = f'<img src="{source}" alt="Plot">' if picture.getvalue() else ""
        return f"<table><caption>{html.escape(title)}</caption>{table}</table>{image}"


# Units of length in which results are shown, the largest first: {spelling: metres}.
METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
# SI units of results whose metre is replaced by another unit of length: {unit: power of the length}.
LENGTH_POWERS = {"m": 1, "m2": 2, "m s-1": 1}


def shown_unit(largest: float, unit: str) -> tuple[str, float]:
    """Return the unit in which a quantity is shown, and its size in `unit`.

    A unit of metres is replaced by the largest unit of METRES that is not larger than the quantity, by the last one if
    all are larger, or by its power.

    largest : largest value of the quantity; unit : its unit, which is replaced if it is in LENGTH_POWERS
    """
    if unit not in LENGTH_POWERS:
        return unit, 1.0
    sizes = [(f"{name}{unit[1:]}", size ** LENGTH_POWERS[unit]) for name, size in METRES.items()]
    return next((each for each in sizes if abs(largest) >= each[1]), sizes[-1])


def span(values: Any, unit: str = "1") -> str:
    """Return the first and last value of an array with their unit, such as "1 to 200 nm"; see `with_unit`."""
    ends = (values[0], values[-1])
    unit, size = shown_unit(max(map(abs, ends)), unit)
    first, last = with_unit(ends[0] / size), f"{with_unit(ends[1] / size)}{'' if unit == '1' else f' {unit}'}"
    return f"{first} to {last}" if len(values) > 1 else last


def with_unit(value: float, unit: str = "1", digits: int = 4) -> str:
    """Return a number as text with `digits` significant digits, followed by its unit unless the unit is "1".

    Metres get a prefix, such as um.
    """
    unit, size = shown_unit(value, unit)
    return f"{float(value) / size:.{digits}g}{'' if unit == '1' else f' {unit}'}"


def si_unit(unit: str, length_unit: str) -> str:
    """Return the SI unit `unit`, or "1" if the unit of length is not known, because the user then chooses all units."""
    return "1" if length_unit == "1" else unit
