"""The page results/index.html, which presents the results of a run without recomputing anything."""
