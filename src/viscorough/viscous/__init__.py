"""Indentation of linear viscoelastic half-spaces: motions from the elastic loading curve, and fits of media to records.

The subpackage `integration` solves the contact problem directly in time, without the loading curve.
"""
