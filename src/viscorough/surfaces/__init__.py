"""Rigid indenters: the class Indenter, generation of rough surfaces, and preparation of measured heights."""
