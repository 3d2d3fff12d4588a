"""Precondition the iterations on a grid by a sparse approximate inverse with a multilevel coarse correction."""
