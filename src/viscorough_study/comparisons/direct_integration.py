"""Compare direct integration of the viscous problem with the paper's law, with and without its factor 1/Γ(2 − α).

Direct integration proceeds from one contact event to the next; at each event another element of the indenter touches.
It never uses the elastic problem. If the viscous problem corresponds exactly to the elastic problem, the depth at time
t under the force F is the elastic depth under the force GFt/η, for any topography. Eqs. (7) to (9) of the paper
multiply this elastic depth by 1/Γ(2 − α), where α is the exponent of the stiffness k ∝ F^α.
"""

import numpy as np
import pandas as pd
from scipy.special import gamma as gamma_function

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough.viscous.integration.events import newtonian_events
from viscorough_study.run.seeds import gamma_factor_key, realization_seed

COLUMNS = {
    "indenter": ("indenter", ""),
    "contact_count": ("elements in contact", "1"),
    "depth_ratio": ("depth of the direct integration over the elastic depth under the force GFt/η", "1"),
    "with_gamma": ("this ratio by Eq. 8: 1/Γ(2 − α); α is exact for sphere and cone, 1/(1 + H) for rough discs", "1"),
}
# {name: (body of revolution, α of its stiffness k ∝ F^α)}. A body z ∝ rⁿ has F ∝ u^(1 + 1/n), so α = 1/(n + 1).
BODIES = {"sphere": (reference.sphere(1.0), 1 / 3), "cone": (reference.cone(1.0), 1 / 2)}
# Smallest and largest contact radius of sphere and cone. The smallest is in elements, and the grid still resolves it;
# the largest is in units of L.
RADII = 6, 0.35
# Integrate sphere and cone up to this contact fraction. It is slightly above the fraction at the largest radius.
BODY_FRACTION = 0.4
DISC_FRACTION = 0.5  # contact fraction at which the integration and the elastic curve of a rough disc end
# The comparison of a rough disc begins at this contact event: before it, too few elements touch for a power law.
FIRST_EVENT = 10
# The comparison of a rough disc ends at this share of the largest force that the integration and the elastic curve
# both reach.
LAST_FORCE = 0.9
TOLERANCE = 1e-6  # tolerance of the elastic loading curve of a rough disc


def compare_direct(*, hursts, elements, impulses, seed):
    """Compare depths by direct integration with elastic depths; return a pandas.DataFrame with `COLUMNS`.

    For sphere and cone the elastic depth is the exact solution, so the ratio of the two depths includes the error of
    the grid. For rough discs, one per Hurst exponent, the elastic depth is computed by boundary elements on the same
    grid.
    hursts : Hurst exponents of the rough discs
    elements : number of elements across every indenter
    impulses : number of impulses ∫F dt/η at which the depths of an indenter are compared
    seed : root of the discs' seeds
    """
    rows = []
    for name, (body, alpha) in BODIES.items():
        events = newtonian_events(body.indenter(elements), until_fraction=BODY_FRACTION)
        radii = np.array([RADII[0], RADII[1] * elements]) / elements
        impulse = np.geomspace(*body.force(body.mdr_profile(radii)), impulses)
        rows += _rows(name, alpha, events, impulse, body.depth(impulse))
    for hurst in hursts:
        disc = self_affine_disc(hurst, elements, seed=realization_seed(seed, *gamma_factor_key(hurst)))
        events = newtonian_events(disc, until_fraction=DISC_FRACTION)
        elastic = indent(disc, tolerance=TOLERANCE, until_fraction=DISC_FRACTION)
        last = LAST_FORCE * min(events.impulse[-1], elastic.force[-1])
        impulse = np.geomspace(events.impulse[FIRST_EVENT], last, impulses)
        alpha = reference.exponent_alpha(hurst)
        rows += _rows(f"rough disc, H = {hurst:g}", alpha, events, impulse, elastic.at_force(impulse)[0])
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _rows(name, alpha, events, impulse, elastic_depth):
    """Return the table rows of one indenter, one row for each impulse ∫F dt/η, with the columns of `COLUMNS`.

    name : name of the indenter; alpha : α in the stiffness k ∝ F^α of the indenter; events : its contact events
    impulse : values of the impulse; elastic_depth : depths of the elastic contact at F/G equal to each impulse
    """
    counts = events.contact_count[events.event_at(impulse)]
    ratios = events.depth_at(impulse) / elastic_depth
    factor = 1 / gamma_function(2 - alpha)
    return [(name, count, ratio, factor) for count, ratio in zip(counts, ratios, strict=True)]
