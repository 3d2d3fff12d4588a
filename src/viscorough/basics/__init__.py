"""Arrays, types, units, elastic constants, errors and messages, and the set-up of compiled code."""
