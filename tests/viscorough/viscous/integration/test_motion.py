"""Direct integrations as motions, against the correspondence on the elastic loading curve.

Motions under force histories are tested with the command that writes them, in tests/viscorough/cli/test_march.py.
"""

import numpy as np

from viscorough import indent, kinetics, march_events, self_affine_disc
from viscorough.viscous.integration.motion import under_constant_force

DISC = self_affine_disc(0.7, 9, seed=1)
FORCE, VISCOSITY = 3.0, 7.0


def test_constant_force():
    """The curve has a level at every contact event, so that nothing is interpolated over one."""
    events = march_events(DISC)
    curve = indent(DISC, tolerance=1e-11, depths=np.unique(events.depth[1:]))
    motion = under_constant_force(events, FORCE / VISCOSITY)
    i = np.searchsorted(motion.depth, curve.depth[5:40])
    elastic = kinetics(curve, FORCE, VISCOSITY, motion.time[i])
    np.testing.assert_allclose(motion.depth[i], elastic.depth, rtol=1e-9)
    np.testing.assert_allclose(motion.velocity[i], np.diff(motion.depth)[i] / np.diff(motion.time)[i], rtol=1e-9)
    assert (motion.overlap == 0).all()
    assert motion.force is None
