"""Define names of models, choices and settings that both tables and figures use."""

# Models for a single surface, for the mean of many surfaces, or for both.
GRID, REQUEST, CONTACT, LAW, PAPER = "grid", "requested error", "one contact", "law", "H/(1 + H)"
MDR, MDR_PI, MDR_FITTED = "MDR", "MDR, λ = π", "MDR, λ fitted"
# Methods that place the levels of a loading curve.
AUTOMATIC, BY_HAND, NAIVE = "automatic", "best by hand", "naive"
# Settings whose values decide whether a method works (robustness.knobs).
STEPS, BOX, RANGE = "explicit steps", "box", "power law"
