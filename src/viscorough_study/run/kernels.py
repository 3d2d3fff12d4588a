"""Compile all numba functions once, before many processes need them.

    python -m viscorough_study.run.kernels

Processes that compile at the same time repeat the work.
"""


def compile_kernels():
    """Compile all functions of the loading path, of the lines and of the direct integration, by running them.

    The disc is large enough for the preconditioner to use coarse grids.
    """
    from viscorough.contact.loading_path import indent
    from viscorough.lines import SelfAffineLines
    from viscorough.mdr import reduce_heights
    from viscorough.surfaces import self_affine_disc
    from viscorough.viscous.integration.events import march_events

    indent(self_affine_disc(0.6, 129, seed=0))
    march_events(self_affine_disc(0.6, 17, seed=0))
    for dtype in ("f4", "f8"):
        lines = SelfAffineLines(0.6, 256, dtype=dtype)
        reduce_heights(lines.heights_in_any_order(0), lines.spacing)


if __name__ == "__main__":
    compile_kernels()
