"""Short texts about a result: lines for print, and a small table of HTML for notebooks."""

from html import escape
from itertools import chain


class Summarised:
    """A result with the method `_summary`, which gives a title, and rows of (quantity, text), one for each line."""

    def __str__(self):
        title, *lines = self._summary()
        return "\n".join([title, *(", ".join(f"{name} {text}" for name, text in line) for line in lines)])

    def _repr_html_(self):
        """A table of the same, which notebooks show."""
        title, *lines = self._summary()
        return html_table(title, chain(*lines))


def span(values, unit="1"):
    """First and last of some values, with their unit: "1e-09 to 2e-07 m"."""
    first, last = (f"{float(values[i]):.4g}" for i in (0, -1))
    return f"{first} to {last}{'' if unit == '1' else f' {unit}'}" if len(values) > 1 else with_unit(values[0], unit)


def with_unit(value, unit="1", digits=4):
    """A number of so many digits, with its unit unless that is "1"."""
    return f"{float(value):.{digits}g}{'' if unit == '1' else f' {unit}'}"


def unit_power(unit, exponent):
    """A unit of length to a power, as UDUNITS spells it: m2, but (1e-6 m)2; "1" for "1"."""
    if unit == "1" or exponent == 0:
        return "1"
    if exponent == 1:
        return unit
    return f"{unit if unit.isascii() and unit.isalpha() else f'({unit})'}{exponent}"


def html_table(title, rows):
    """A table of HTML with a caption and one row for every (quantity, value)."""
    body = "".join(
        f'<tr><th scope="row" style="text-align:left">{escape(name)}</th>'
        f'<td style="text-align:left">{escape(value)}</td></tr>'
        for name, value in rows
    )
    return f'<table><caption style="text-align:left">{escape(title)}</caption><tbody>{body}</tbody></table>'
