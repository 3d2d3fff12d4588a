"""Direct integrations of the viscous problem against the law with and without the factor 1/Γ(2 − α).

The integration goes from contact event to contact event and never uses the correspondence with the elastic problem. If
that is exact, the depth at time t is the elastic depth under the force GFt/η, for any topography; Eqs. (7) to (9) make
it 1/Γ(2 − α) times that.
"""

import numpy as np
import pandas as pd
from scipy.special import gamma as gamma_function

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough.viscous.events import march_events
from viscorough_study.seeds import gamma_factor_key, realization_seed

COLUMNS = {
    "case": ("indenter", ""),
    "alpha": ("α of κ ∝ X^α: exact for sphere and cone, 1/(1 + H) for rough discs", "1"),
    "contact_count": ("elements in contact", "1"),
    "depth_ratio": ("depth of the direct integration over the elastic depth under the force GFt/η", "1"),
    "with_gamma": ("the same by Eq. 8: 1/Γ(2 − α)", "1"),
}
# α of bodies z ∝ rⁿ, for which F ∝ u^(1 + 1/n): k ∝ F^(1/(n + 1))
BODIES = {"sphere": (reference.sphere(1.0), 1 / 3), "cone": (reference.cone(1.0), 1 / 2)}


def compare_direct(hursts, across, seed, *, impulses=25):
    """Depths by direct integration over elastic depths; a pandas.DataFrame with the columns of `COLUMNS`.

    Sphere and cone: over the exact elastic solution, so that the ratio has the error of the grid. Rough discs, one for
    each Hurst exponent: over the loading curve by boundary elements of the same disc.
    hursts : Hurst exponents; across : elements across all indenters; seed : root of the discs' seeds
    """
    rows = []
    for name, (body, alpha) in BODIES.items():
        events = march_events(body.indenter(across), until_fraction=0.4)
        impulse = np.geomspace(*body.force(body.mdr_profile(np.array([6, 0.35 * across]) / across)), impulses)
        rows += _rows(name, alpha, events, impulse, body.depth(impulse))
    for hurst in hursts:
        disc = self_affine_disc(hurst, across, seed=realization_seed(seed, *gamma_factor_key(hurst)))
        events, elastic = march_events(disc, until_fraction=0.5), indent(disc, tolerance=1e-6, until_fraction=0.5)
        impulse = np.geomspace(events.impulse[10], 0.9 * min(events.impulse[-1], elastic.force[-1]), impulses)
        alpha = reference.exponent_alpha(hurst)
        rows += _rows(f"rough disc, H = {hurst:g}", alpha, events, impulse, elastic.at_force(impulse)[0])
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _rows(case, alpha, events, impulse, elastic_depth):
    counts = events.contact_count[events.event_at(impulse)]
    ratios = events.depth_at(impulse) / elastic_depth
    factor = 1 / gamma_function(2 - alpha)
    return [(case, alpha, count, ratio, factor) for count, ratio in zip(counts, ratios, strict=True)]
