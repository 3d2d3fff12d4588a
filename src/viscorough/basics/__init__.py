"""Basic modules that all other packages use: arrays, types, units, elastic constants, errors, messages, compilation."""
