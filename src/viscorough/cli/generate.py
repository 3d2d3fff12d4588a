"""`viscorough generate`: make a random self-affine surface."""

from pathlib import Path
from typing import Any

import click

from viscorough.basics.units import Quantity
from viscorough.cli import files, messages, options
from viscorough.io import suffixes


@click.command(cls=options.Command, short_help="A random self-affine disc or line.")
@click.option("--hurst", type=click.FloatRange(0, 1), required=True, help="Hurst exponent H, from 0 to 1.")
@click.option("--elements", type=click.IntRange(min=3), help="Disc of so many elements across its diameter.")
@click.option("--points", type=click.IntRange(min=2), help="Line of so many points, instead of a disc.")
@click.option("--rms", type=options.QuantityOption("m"), required=True, help="Rms height, exact in every realization.")
@click.option(
    "--diameter", type=options.QuantityOption("m"), required=True, help="Diameter of the disc, or length of the line."
)
@click.option("--unit", default="m", help="Unit of length, such as um; 1 if it does not matter.")
@click.option("--seed", type=click.IntRange(min=0), required=True, help="The same seed gives the same surface.")
@click.option("--roll-off", type=options.PositiveNumber(), help="Longest wavelength of the power law, in diameters.")
@click.option("--plateau", is_flag=True, help="With --roll-off: longer waves have the spectral density there.")
@options.output("SURFACE.nc", allowed=suffixes.MAPS)
def generate(
    *,
    hurst: float,
    elements: int | None,
    points: int | None,
    rms: Quantity,
    diameter: Quantity,
    unit: str,
    seed: int,
    roll_off: float | None,
    plateau: bool,
    output: Path,
) -> None:
    """Make a random self-affine disc as an indenter, or a random self-affine line for viscorough reduce.

    The power spectral density falls with the wave number q as q^(-2(H+1)) for a disc and as q^(-(2H+1)) for a line,
    down to wavelengths of two spacings. SURFACE.nc has the variable heights, nan outside the disc. It also has
    coordinates and units, so other commands need no options for spacing and unit.

    \b
    Example:
        viscorough generate --hurst 0.8 --elements 129 --rms 0.2 --diameter 129 \\
            --unit um --seed 1 -o disc.nc
        viscorough generate --hurst 0.8 --points 100000 --rms "200 nm" \\
            --diameter "1 mm" --seed 1 -o line.nc
        viscorough indent disc.nc -o curve.nc
    """
    options.require((elements is None) != (points is None), "either --elements (a disc) or --points (a line) is needed")
    options.require(not plateau or roll_off is not None, "--plateau is for use with --roll-off")

    from viscorough.basics import units
    from viscorough.io.heights import surface_to_content
    from viscorough.surfaces.lines import self_affine_line
    from viscorough.surfaces.self_affine import self_affine_disc

    files.check_output(output)
    unit = unit if unit == units.UNKNOWN else units.length_unit(unit)
    h, length = units.in_si(rms, "m", unit, "--rms"), units.in_si(diameter, "m", unit, "--diameter")
    long_waves = {"roll_off_wavelength": roll_off, "roll_off_level": float(plateau)}
    how: dict[str, Any] = {"rms": h, "length_unit": "m" if unit != units.UNKNOWN else unit, "seed": seed, **long_waves}
    if elements:
        made = self_affine_disc(hurst, elements, diameter=length, **how)
        text = f"disc of {elements} elements across, {made.elements} elements"
    elif points:
        made = self_affine_line(hurst, points, length=length, **how)
        text = f"line of {points} points"
    h, length = files.in_unit(h, unit), files.in_unit(length, unit)
    about = {"hurst": hurst, "rms": h, "diameter": length, "seed": seed} | (long_waves if roll_off else {})
    files.write_output(surface_to_content(made), output, unit, **about)
    messages.announce(output, f"{text}, rms height {h:g} {unit}, rms slope {made.rms_slope:.3g}")
