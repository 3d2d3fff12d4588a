"""Tables of measured surfaces: lengths, and power laws of their groups."""

import json
from itertools import chain

import pandas as pd

from viscorough_study.ensembles.pool import ensembles
from viscorough_study.fits.fit_table import fit_rows

COLUMNS = {
    "scan": ("name of the scan", None),
    "group": ("group of scans", None),
    "file": ("file of heights", None),
    "elements": ("elements of the indenter", "1"),
    "spacing": ("distance between neighbouring columns", "m"),
    "row_spacing": ("distance between neighbouring rows", "m"),
    "rms": ("rms height h, as prepared", "m"),
    "rms_slope": ("rms slope, as prepared", "1"),
    "diameter": ("diameter L of the circle of equal area", "m"),
}


def measured_tables(pool, *, fit, seed):
    """{"measured_scans", "measured_fits": table} of measured surfaces, with `COLUMNS` and those of fit_table.

    pool : of all scans; fit : settings in section `scaling`
    """
    scans = []
    for name, made_from in json.loads(pool.attrs["settings"]).items():
        (settings,) = made_from["ensembles"]
        scans.append({"scan": name, "group": settings["group"], "file": settings["file"]} | settings["lengths"])
    groups = ensembles(pool, "group").items()
    fits = [fit_rows(ensemble, source="measured", case_group=group, seed=seed, **fit) for group, ensemble in groups]
    return {"measured_scans": pd.DataFrame(scans), "measured_fits": pd.DataFrame(chain.from_iterable(fits))}
