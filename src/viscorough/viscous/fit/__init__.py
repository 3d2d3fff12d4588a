"""Fits of media to measured records."""
