"""Realizations of surfaces: discs, batches of their curves, pools, and averages on common abscissae."""
