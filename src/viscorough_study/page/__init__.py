"""Generation of the page results/index.html from the results of a run; nothing is recomputed."""
