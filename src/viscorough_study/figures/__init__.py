"""Figures, one module for each: it draws a matplotlib Figure from tables and ensembles, and computes nothing."""
