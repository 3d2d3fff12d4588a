"""Stand-in for SurfaceTopography: a map of heights."""


class Topography:
    def __init__(self, heights, physical_sizes):
        self.heights, self.physical_sizes = heights, physical_sizes
