"""Names of models, choices and settings that tables and figures share."""

# Models of one surface, of the mean of many, or of both.
GRID, REQUEST, CONTACT, LAW, PAPER = "grid", "requested error", "one contact", "law", "H/(1 + H)"
MDR, MDR_PI, MDR_FITTED = "MDR", "MDR, λ = π", "MDR, λ fitted"
# Placements of levels.
AUTOMATIC, BY_HAND, NAIVE = "automatic", "best by hand", "naive"
# Settings that decide whether a method works.
STEPS, BOX, RANGE = "explicit steps", "box", "power law"
