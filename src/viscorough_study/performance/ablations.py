"""Ablations of the contact solver: options that leave out or replace one of its parts.

A solution without a part measures its contribution; a solution by one part alone shows where it fails.
"""

from dataclasses import replace

from viscorough.contact.options import SolverOptions

DOUBLE_PRECISION = SolverOptions(precision="double", exact_gap_below=0.0)
# The gap is never recomputed in double precision.
SINGLE_PRECISION_ONLY = SolverOptions(exact_gap_below=0.0, operator_rounding=0.0)
# Weaker preconditioners have no natural length of a step.
NO_PRECONDITIONER = SolverOptions(preconditioner="none", release_step=0.0)
NO_COARSE_CORRECTION = SolverOptions(preconditioner="sparse", release_step=0.0)
NO_TANGENT = SolverOptions(warm_start="pressure")
DENSE_ONLY = SolverOptions(dense_contacts=10**9, dense_interactions=10**12)
GRID_ONLY = {
    "single": SolverOptions(dense_contacts=0, dense_interactions=0),
    "double": replace(DOUBLE_PRECISION, dense_contacts=0, dense_interactions=0),
}
NO_PADDING = {precision: replace(options, padding=False) for precision, options in GRID_ONLY.items()}
