"""Define names of models, methods and settings that both tables and figures use."""

# Names of models, which are numerical methods or formulas. A model predicts the contact of a single surface, the mean
# over many surfaces, or both.
GRID, CONTACT, LAW, PAPER = "grid", "one contact", "law", "H/(1 + H)"
MDR, MDR_PI, MDR_FITTED = "MDR", "MDR, λ = π", "MDR, λ fitted"
# Choices of the study that the paper leaves open (fits.conventions): the kind of mean over realizations, the region
# where h is measured in reading A, the window of the fit, and the form of the law, Eqs. 1 and 3 without Γ.
SHOWN = {"average": "geometric", "rms_convention": "disc", "window_rule": "default", "gamma": "without"}
MEAN_X = (0.01, 1.0)  # range of X in which the means of many surfaces are compared
WINDOWS = ("own region", "same X", "same κ")  # windows in which exponents of lines and of discs are compared
PAPER_GRID = 257  # elements across the discs of the paper
