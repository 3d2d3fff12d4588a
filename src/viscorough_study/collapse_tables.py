"""All tables of the collapse of curves on grids from coarse to fine: of discs, of their control and of lines."""

import pandas as pd

from viscorough_study.infinite_grid import limit_table
from viscorough_study.scaling_collapse import collapse_table, curve_table, grids

CURVES_END = 1.0  # X up to which curves are drawn


def collapse_tables(discs, lines, ranges, *, tolerance, **how):
    """{"collapse", "infinite", "curves": pandas.DataFrame}, with columns of the modules that make them.

    discs, lines : pools of grids from coarse to fine; ranges : setting `collapse`; tolerance : of exponents
    how : average, rms_convention, fraction_min and seed, as in `viscorough_study.scaling_collapse.grids`
    """
    how |= {"elements_min": min(ranges["elements_min"]), "resamples": ranges["resamples"]}
    ends = {"power": ranges["x_high"], "corrected": ranges["corrected_x_high"]}
    parts = {"collapse": [], "infinite": []}
    for source, pool in (("discs", discs), ("controls", discs), ("lines", lines)):
        found = grids(pool, source, **how)
        parts["collapse"].append(collapse_table(found, source, x_high=ranges["x_high"], tolerance=tolerance))
        if source == "discs":
            curves = curve_table(found, CURVES_END)
        if source != "controls":
            about = {"elements_min": ranges["elements_min"], "x_high": ends, "tolerance": tolerance}
            parts["infinite"].append(limit_table(found, source, **about))
    return {name: pd.concat(tables, ignore_index=True) for name, tables in parts.items()} | {"curves": curves}
