"""Calibrated penetration law of rough discs, and estimates of depth and velocity from this law."""
