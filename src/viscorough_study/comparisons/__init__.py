"""Comparisons of results with exact solutions, other methods and media, measured surfaces, and the literature."""
