"""Verdicts on the claims of the paper: the evidence, a criterion for each claim, and summaries."""
