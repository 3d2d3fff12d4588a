"""Measure the errors of three methods, each as a function of a setting that decides whether the method works.

- Explicit steps: the setting is the number of time steps, in equal ratios of time, on a rough disc. The error is the
  largest error of the depth, relative to integration from contact event to contact event.
- Box: a map is surrounded by empty space to form a box. The setting is the ratio of the width of the box to the width
  of the map. Fourier transforms convolve periodically: in a box less than twice as wide as the map, distant elements
  act on each other over the shorter distance, across the edge of the box. The error is the error of the stiffness of a
  flat disc whose elements all touch, relative to a box that is wide enough.
- Power law: the setting is X = Ft/(4ηhL). The error is the deviation of X^β/ζ, as fitted in region (b), from the
  geometric mean of vt/h of the discs.
"""

import warnings

import numpy as np
import pandas as pd

from viscorough.basics.errors import AccuracyWarning
from viscorough.contact.halfspace.influence import influence_coefficient
from viscorough.surfaces.self_affine import cut_disc, self_affine_disc
from viscorough.viscous.integration.events import newtonian_events
from viscorough.viscous.integration.stepping import newtonian_steps
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.conventions import fits
from viscorough_study.run.names import BOX, RANGE, STEPS
from viscorough_study.run.seeds import failure_map_key, realization_seed

HURST = 0.7  # Hurst exponent of the disc for the explicit steps, which most stress-test cases have, too
NUMBERS = (8, 32, 128, 512, 2048)  # numbers of explicit time steps that are compared
FRACTIONS = (0.02, 0.5)  # smallest and largest contact fraction at which depths are compared
COMPARED = 6  # number of impulses ∫F dt/η at which depths are compared
COLUMNS = {
    "knob": ("explicit steps, box, or power law", ""),
    "hurst": ("Hurst exponent of the surface; missing for a flat disc", "1"),
    "value": ("number of steps, width of the box over the width of the map, or X", "1"),
    "error": ("largest relative error of depth, stiffness or velocity", "1"),
    "warned": ("1 if the user is warned, else 0", "1"),
}


def failure_knobs(discs, scaling, *, seed, across, conventions):
    """Measure the errors of three methods as functions of a setting (see the module); return a table with `COLUMNS`.

    discs : pool of discs (ensembles.pool); scaling : table of fitted power laws
    seed : root seed; across : number of elements across the disc of the explicit steps, and across the flat disc
    conventions : choices that the paper leaves open, {name of the choice: value used in the figures}
        (fits.conventions)
    """
    rows = [*_step_rows(seed, across), *_box_rows(across), *_range_rows(discs, scaling, conventions)]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _step_rows(seed, across):
    disc = self_affine_disc(HURST, across, seed=realization_seed(seed, *failure_map_key()))
    events = newtonian_events(disc, until_fraction=FRACTIONS[1])
    # Begin with at least two elements in contact, because the first element touches at an impulse of zero.
    first = events.impulse[np.searchsorted(events.contact_count, max(FRACTIONS[0] * disc.elements, 2))]
    impulses = np.geomspace(first, events.impulse[-1] * (1 - 1e-9), COMPARED)
    for number in NUMBERS:
        ends = np.union1d(np.geomspace(impulses[0] / number, impulses[-1], number + 1)[1:], impulses)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", AccuracyWarning)
            steps = newtonian_steps(disc, ends, scheme="explicit")
        depth = steps.depth[np.searchsorted(steps.impulse, impulses)]
        yield STEPS, HURST, number, np.abs(depth / events.depth_at(impulses) - 1).max(), int(bool(caught))


def _box_rows(across):
    exact = periodic_stiffness(across, 2 * across)
    for width in range(across, 2 * across + 1):
        yield BOX, np.nan, width / across, abs(periodic_stiffness(across, width) / exact - 1), 0


def periodic_stiffness(across, width):
    """Compute the stiffness of a flat disc in a periodic box: the sum of its pressures at a depth of 1.

    The result is in reduced units. Any two elements act on each other over the shorter distance, directly or across the
    edge of the box: a convolution by Fourier transforms.
    across, width : number of elements across the disc and across the box
    """
    place = np.argwhere(np.isfinite(cut_disc(np.zeros((across, across)), across)))
    row, column = np.moveaxis(np.abs(place[:, None] - place), -1, 0)
    influence = influence_coefficient(np.minimum(row, width - row), np.minimum(column, width - column))
    return float(np.linalg.solve(influence, np.ones(len(place))).sum())


def _range_rows(discs, scaling, conventions):
    base = ensembles(select(discs, group="base"), "hurst", rms_convention=conventions["rms_convention"])
    laws = fits(scaling, conventions, source="discs", case_group="base").set_index("hurst")
    for hurst, law in laws.iterrows():
        x, velocity = base[hurst]["x"].values, base[hurst]["velocity_geometric"].values
        has_velocity = np.isfinite(velocity) & (base[hurst]["contact_count_median"].values > 1)
        for abscissa, exact in zip(x[has_velocity], velocity[has_velocity], strict=True):
            yield RANGE, hurst, abscissa, abs(abscissa ** law["beta"] / law["zeta"] / exact - 1), 0
