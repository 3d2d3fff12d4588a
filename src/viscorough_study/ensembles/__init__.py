"""Generate or read surfaces, compute and store their loading curves, and average them over ensembles."""
