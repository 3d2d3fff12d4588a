"""Stand-in for ContactMechanics: the part of its interface that the adapter uses, solved exactly by a dense matrix."""


class FreeFFTElasticHalfSpace:
    def __init__(self, nb_grid_pts, young, physical_sizes):
        self.nb_grid_pts, self.young, self.side = nb_grid_pts, young, physical_sizes[0] / nb_grid_pts[0]
