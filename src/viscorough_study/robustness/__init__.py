"""Failures of the methods, and whether they are reported."""
