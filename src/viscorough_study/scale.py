"""The scale of a run beside the paper's, and whether verdicts at this scale decide anything."""

SMALLEST_SHARE = 0.5  # of the paper's elements across and realizations; below, verdicts say nothing about the claims


def scale(evidence):
    """Attributes of the table of verdicts: what was computed, taken from the results and not from the settings.

    elements_across : of the discs; realizations : discs of the Hurst exponent with the fewest of them
    paper_elements_across, paper_realizations : the paper's, the latter for each of its curves
    decisive : 1 if both are at least half of the paper's, else 0
    scale : the same in words
    """
    across, ensembles = evidence.across, evidence.pooled.values()
    realizations = min(ensemble.sizes["realization"] for ensemble in ensembles)
    said = [evidence.said("boundary_elements", name) for name in ("elements_across", "realizations_min")]
    decisive = across >= SMALLEST_SHARE * said[0] and realizations >= SMALLEST_SHARE * said[1]
    words = f"discs of {across} elements across (paper: {said[0]}), "
    words += f"at least {realizations} of every Hurst exponent (paper: {said[1]} for every curve)"
    if not decisive:
        words += "; too few to decide anything, the verdicts mean nothing"
    return {
        "elements_across": across,
        "realizations": realizations,
        "paper_elements_across": said[0],
        "paper_realizations": said[1],
        "decisive": int(decisive),
        "scale": words,
    }
