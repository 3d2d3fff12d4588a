"""Stand-in for ContactMechanics: the part of its interface that the adapter uses, solved exactly by a dense matrix."""

import dense_contact


class FreeFFTElasticHalfSpace:
    """Forces on the elements, not pressures; those that press the half-space down are negative."""

    def __init__(self, nb_grid_pts, young, physical_sizes):
        self.nb_grid_pts, self.young, self.side = nb_grid_pts, young, physical_sizes[0] / nb_grid_pts[0]

    def evaluate_disp(self, forces):
        assert forces.shape == self.nb_grid_pts
        return dense_contact.displacement(-forces / self.side**2, self.young, self.side)
