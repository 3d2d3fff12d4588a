"""The linearly viscous half-space: the correspondence with the elastic one, and direct integration in time."""
