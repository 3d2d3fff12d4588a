"""Results of computations: loading curves, contacts and motions."""
