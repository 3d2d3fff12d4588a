"""The figures, drawn from tables and ensembles only."""
