"""Compute deflections of an elastic half-space by uniform pressures on the rectangular elements of a grid."""
