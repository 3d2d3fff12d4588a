"""Compare direct integration of the viscous problem with the law, with and without the factor 1/Γ(2 − α).

The integration proceeds from contact event to contact event and never uses the correspondence with the elastic problem.
If the correspondence is exact, the depth at time t is the elastic depth under the force GFt/η, for any topography;
Eqs. (7) to (9) multiply this depth by 1/Γ(2 − α).
"""

import numpy as np
import pandas as pd
from scipy.special import gamma as gamma_function

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough.viscous.integration.events import march_events
from viscorough_study.run.seeds import gamma_factor_key, realization_seed

COLUMNS = {
    "case": ("indenter", ""),
    "contact_count": ("elements in contact", "1"),
    "depth_ratio": ("depth of the direct integration over the elastic depth under the force GFt/η", "1"),
    "with_gamma": ("this ratio by Eq. 8: 1/Γ(2 − α); α is exact for sphere and cone, 1/(1 + H) for rough discs", "1"),
}
# α of bodies z ∝ rⁿ: F ∝ u^(1 + 1/n), so k ∝ F^(1/(n + 1))
BODIES = {"sphere": (reference.sphere(1.0), 1 / 3), "cone": (reference.cone(1.0), 1 / 2)}
RADII = 6, 0.35  # smallest contact radius compared [elements], which the grid resolves, and largest [L]
BODY_FRACTION = 0.4  # contact fraction slightly above the fraction at the largest radius
DISC_FRACTION = 0.5  # largest contact fraction in the integration of rough discs
FIRST_EVENT = 10  # first event of a rough disc: before it, too few elements are in contact for a power law
LAST_FORCE = 0.9  # fraction of the largest force that both curves reach
TOLERANCE = 1e-6  # tolerance of the elastic curve


def compare_direct(*, hursts, elements, impulses, seed):
    """Return depths by direct integration over elastic depths, as a pandas.DataFrame with the columns of `COLUMNS`.

    For sphere and cone the elastic depth is the exact solution, so the ratio includes the error of the grid. For rough
    discs, one for each Hurst exponent, it is the depth of the same disc by boundary elements.
    hursts : Hurst exponents;
    elements : across all indenters; impulses : number of impulses ∫F dt/η per indenter
    seed : root of the discs' seeds
    """
    rows = []
    for name, (body, alpha) in BODIES.items():
        events = march_events(body.indenter(elements), until_fraction=BODY_FRACTION)
        radii = np.array([RADII[0], RADII[1] * elements]) / elements
        impulse = np.geomspace(*body.force(body.mdr_profile(radii)), impulses)
        rows += _rows(name, alpha, events, impulse, body.depth(impulse))
    for hurst in hursts:
        disc = self_affine_disc(hurst, elements, seed=realization_seed(seed, *gamma_factor_key(hurst)))
        events = march_events(disc, until_fraction=DISC_FRACTION)
        elastic = indent(disc, tolerance=TOLERANCE, until_fraction=DISC_FRACTION)
        last = LAST_FORCE * min(events.impulse[-1], elastic.force[-1])
        impulse = np.geomspace(events.impulse[FIRST_EVENT], last, impulses)
        alpha = reference.exponent_alpha(hurst)
        rows += _rows(f"rough disc, H = {hurst:g}", alpha, events, impulse, elastic.at_force(impulse)[0])
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _rows(case, alpha, events, impulse, elastic_depth):
    """Rows of one indenter, one for each impulse."""
    counts = events.contact_count[events.event_at(impulse)]
    ratios = events.depth_at(impulse) / elastic_depth
    factor = 1 / gamma_function(2 - alpha)
    return [(case, count, ratio, factor) for count, ratio in zip(counts, ratios, strict=True)]
