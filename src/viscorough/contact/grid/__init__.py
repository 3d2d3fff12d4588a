"""Solve contacts on a grid of the elements around the contact, by iterations with the half-space operator."""
