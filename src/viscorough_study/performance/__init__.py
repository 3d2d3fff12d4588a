"""Measurements of the cost and the accuracy of every method."""
