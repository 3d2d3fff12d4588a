"""Indentation of linear viscoelastic half-spaces: motions from the elastic loading curve, and fits of media to records.

The subpackage `integration` integrates the contact problem directly in time.
"""
