"""Generation of the page results/index.html and of the article from the results of a run; nothing is recomputed."""
