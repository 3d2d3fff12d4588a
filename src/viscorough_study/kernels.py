"""Compile the functions that numba compiles, once, before many processes need them.

    python -m viscorough_study.kernels

Processes that compile into numba's cache at the same time do the same work several times, and can crash.
"""


def compile_kernels():
    """Run what compiles all functions of the loading path, of the lines and of the direct integration.

    The disc is large enough for the preconditioner to use coarse grids.
    """
    from viscorough.contact.loading_path import indent
    from viscorough.mdr import reduce
    from viscorough.surfaces import self_affine_disc, self_affine_line
    from viscorough.viscous.events import march_events

    indent(self_affine_disc(0.6, 129, seed=0))
    march_events(self_affine_disc(0.6, 17, seed=0))
    for dtype in ("f4", "f8"):
        reduce(self_affine_line(0.6, 256, seed=0, dtype=dtype))


if __name__ == "__main__":
    compile_kernels()
