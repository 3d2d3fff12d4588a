"""Files: atomic writing, NetCDF, maps of heights, loading curves, motion over time."""
