"""`viscorough kinetics`: a loading curve to penetration over time."""

import click

from viscorough.cli.elasticity import check_incompressible
from viscorough.cli.messages import announce
from viscorough.cli.options import (
    FILE,
    PositiveNumber,
    output_option,
    read_content,
    write_output,
)


@click.command(short_help="Penetration over time under a constant force.")
@click.argument("curve", type=FILE, metavar="CURVE.nc")
@click.option("--force", type=PositiveNumber(), required=True, help="Constant force F, applied at time 0.")
@click.option("--viscosity", type=PositiveNumber(), required=True, help="Shear viscosity of the half-space.")
@output_option("KIN.nc")
def kinetics(curve, force, viscosity, output):
    """Penetration over time, under a constant force, of the indenter whose loading curve is in CURVE.nc.

    For each level of the curve, the time at which the indenter has penetrated a linearly viscous half-space to that
    depth, and the velocity there: time = (F/G) VISCOSITY/FORCE, velocity = FORCE/(VISCOSITY k/G). This
    correspondence is exact. KIN.nc is CURVE.nc with the variables time (in s) and velocity added.

    The unit of force is your choice; the viscosity is then in (unit of force) s/(unit of length)^2, where the unit
    of length is that of the curve. With heights in metres and the force in newtons this is Pa s; with
    heights in micrometres and the force in newtons, 1 Pa s = 1e-12 N s/um^2.

    \b
    Example, 5 N on a medium of 1e6 Pa s, heights in metres:
        viscorough kinetics curve.nc --force 5 --viscosity 1e6 -o kinetics.nc
    """
    import numpy as np

    from viscorough.io.atomic import check_output
    from viscorough.io.curves import curve_from_content
    from viscorough.io.motion import with_motion
    from viscorough.viscous import correspondence

    check_output(output)
    content = read_content(curve)
    check_incompressible(content, curve)
    try:
        loading = curve_from_content(content)
    except ValueError as error:
        raise ValueError(f"{curve}: {error}") from error
    motion = correspondence.kinetics(loading, force, viscosity)
    if not (np.diff(motion.time, prepend=0) > 0).all() or not (motion.velocity > 0).all():
        raise ValueError(f"--force {force:g}, --viscosity {viscosity:g}: times overflow; closer values are allowed")
    write_output(
        with_motion(content, motion.time, motion.velocity),
        output,
        title="Penetration of a rigid indenter into a linearly viscous half-space under a constant force",
        force=force,
        viscosity=viscosity,
        correspondence="depth at a time is the elastic one at F/G = force * time / viscosity, velocity is "
        "force / (viscosity * k/G) there; exact for every topography, without 1/Gamma(2 - alpha)",
    )
    announce(output, f"{motion.time.size} levels, depth {motion.depth[-1]:.6g} at time {motion.time[-1]:.6g}")
