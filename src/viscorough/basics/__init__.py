"""Basic modules for all other packages: arrays, types, units, elastic constants, errors, messages, compilation."""
