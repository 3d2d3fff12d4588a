"""The direct integration of the viscous problem against the elastic loading path."""

import numpy as np
import pytest

from viscorough import Indenter, indent, self_affine_disc
from viscorough.viscous.integration.events import newtonian_events


@pytest.mark.parametrize(("hurst", "spacings"), [(0.2, 1 / 33), (0.8, 1 / 33), (0.6, (1.0, 2.0)), (0.6, (5.0, 1.0))])
def test_depths_agree_with_the_correspondence_over_the_whole_curve(hurst, spacings):
    """Under constant force F/G of the elastic curve is F t/η. The only common code is contact.halfspace."""
    disc = Indenter(self_affine_disc(hurst, 33, seed=3).heights, spacings)
    events = newtonian_events(disc)
    assert events.contact_count[-1] == disc.elements
    depths = np.unique(events.depth[1:])[:: disc.elements // 40]
    elastic = indent(disc, tolerance=1e-11, depths=depths)
    impulse = np.interp(depths, events.depth, events.impulse)
    np.testing.assert_allclose(elastic.force, impulse, rtol=1e-10)


def test_too_many_elements_for_the_memory_are_refused():
    with pytest.raises(MemoryError, match=r"elements in contact takes .* bytes of memory, .* bytes are available"):
        newtonian_events(Indenter(np.random.default_rng(1).random((600, 600)), 1.0))


def test_invalid_arguments_are_refused():
    with pytest.raises(ValueError, match="two-dimensional"):
        newtonian_events(Indenter(np.zeros(3), 1.0))
    with pytest.raises(ValueError, match="until"):
        newtonian_events(Indenter(np.zeros((3, 3)), 1.0), until_fraction=0)
    with pytest.raises(ValueError, match="depths overflow"):
        newtonian_events(Indenter(3e307 * np.random.default_rng(1).random((9, 9)), 1.0))
