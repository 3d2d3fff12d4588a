"""The calibrated penetration law, and the depths that it gives."""
