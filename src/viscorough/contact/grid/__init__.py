"""Contacts on the grid of the elements around the contact: iterations with the half-space operator, and their loops."""
