"""Seeds of everything random, from one root and a key of integers."""

import numpy as np


def realization_seed(root, *key):
    """Seed of one realization, from a root and a key of integers >= 0; other keys give independent ones."""
    return np.random.SeedSequence(root, spawn_key=key)
