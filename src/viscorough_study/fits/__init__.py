"""Fits to ensembles: power laws, constant slopes, laws of ζ, the interface, and trends with the grid."""
