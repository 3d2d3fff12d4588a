"""The scale of a run beside the paper's."""

SMALLEST_SHARE = 0.5  # of the paper's elements across; below, region (b) is hardly as long as a fit needs


def is_trial(elements_across, paper_elements_across):
    """Whether discs are so coarse that no power law can be found on them, and verdicts mean nothing."""
    return elements_across < SMALLEST_SHARE * paper_elements_across


def attributes_of_scale(evidence):
    """Attributes of the table of verdicts: what was computed, taken from the results and not from the settings.

    elements_across : of the discs; paper_elements_across : of those of the paper
    realizations : discs of the Hurst exponent with the fewest of them
    trial : 1 for a trial, whose verdicts mean nothing, else 0
    scale : the same in words
    """
    across, paper = evidence.across, evidence.said("boundary_elements", "elements_across")
    realizations = min(ensemble.sizes["realization"] for ensemble in evidence.pooled.values())
    trial = is_trial(across, paper)
    words = (
        f"at least {realizations} discs of {across} elements across for every Hurst exponent (paper: {paper} across)"
    )
    return {
        "elements_across": across,
        "paper_elements_across": paper,
        "realizations": realizations,
        "trial": int(trial),
        "scale": words + "; too coarse for a power law, the verdicts mean nothing" * trial,
    }
