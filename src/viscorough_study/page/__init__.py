"""The page results/index.html, which shows what a run has found: made from results, without computing again."""
