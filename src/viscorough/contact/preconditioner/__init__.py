"""Preconditioner of the iterations on a grid: a sparse approximate inverse with a multilevel coarse correction."""
