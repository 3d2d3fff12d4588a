"""Read and write files: maps of heights, loading curves, contacts, motions, media, tables and figures."""
