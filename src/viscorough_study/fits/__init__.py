"""Fits to ensembles of loading curves: power laws, prefactors ζ, rough interfaces, and the effect of the grid."""
