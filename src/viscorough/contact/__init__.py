"""Frictionless contact of a rigid indenter with the elastic half-space, solved with boundary elements."""
