"""Comparisons: MDR, direct integration, exact solutions, other media, measured surfaces, literature."""
