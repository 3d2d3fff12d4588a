"""Find the Pareto front and the fastest methods in tables of costs."""

import numpy as np


def pareto_front(table):
    """Return rows of a table that no other row beats in both wall time and error, from fast to accurate."""
    ordered = table.sort_values(["wall_s", "error"])
    return ordered[ordered["error"] < ordered["error"].cummin().shift(fill_value=np.inf)]


def fastest(table, error):
    """Return {group of methods: its fastest row within an error}, without groups that do not reach it."""
    reached = table[table["error"] <= error]
    return {group: rows.loc[rows["wall_s"].idxmin()] for group, rows in reached.groupby("group", sort=False)}
