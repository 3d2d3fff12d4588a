"""Figures of the study. Each module draws one matplotlib Figure from tables and ensembles, and computes no results."""
