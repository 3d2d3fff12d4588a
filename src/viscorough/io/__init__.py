"""Files: atomic writing, NetCDF, heights and loading curves."""
