"""Comparisons with the MDR, direct integration, exact solutions, other media, measured surfaces and the literature."""
