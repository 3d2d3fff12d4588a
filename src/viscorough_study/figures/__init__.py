"""The figures: one module for each, which draws a matplotlib Figure from tables and ensembles and computes nothing."""
