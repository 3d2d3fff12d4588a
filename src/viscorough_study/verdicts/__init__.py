"""The verdict on each claim of the paper: the evidence, a criterion for each claim, and the words for both."""
