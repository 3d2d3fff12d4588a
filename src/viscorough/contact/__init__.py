"""Frictionless contact with the elastic half-space by boundary elements."""
