"""The tables of measured surfaces: the scans, the power laws of their groups, and their kinetics."""

import json

import pandas as pd

from viscorough.io.curves import unstack_curves
from viscorough_study.fit_table import fit_rows
from viscorough_study.measured_kinetics import COLUMNS as KINETICS
from viscorough_study.measured_kinetics import scan_kinetics


def scans_and_kinetics(batches, *, names, forces, media, times):
    """Tables with the columns of `measured` and of `measured_kinetics`.

    batches : Content of the curve of each scan; names : of the scans; forces : of each scan [N]
    media : {name: medium} in Pa and s; times : t > 0, increasing [s]
    """
    scans, motions = [], []
    for name, batch, of_scan in zip(names, batches, forces, strict=True):
        (curve,), settings = unstack_curves(batch), json.loads(batch.attributes["settings"])
        same = {"scan": name, "group": settings["group"]}
        scans.append(same | {"file": settings["file"]} | settings["lengths"])
        motions += [part.assign(**same) for part in scan_kinetics(curve, media, of_scan, times)]
    motion = pd.concat(motions, ignore_index=True)[list(KINETICS)] if motions else pd.DataFrame(columns=list(KINETICS))
    return pd.DataFrame(scans), motion


def group_fits(groups, **how):
    """Table of the power laws of groups, with the columns of `fit_table`.

    groups : {name: ensemble dataset of its scans}; how : resamples, seed and limits of fit_table.fit_rows
    """
    rows = [fit_rows(ensemble, source="measured", case_group=group, **how) for group, ensemble in groups.items()]
    return pd.DataFrame([row for rows_of_group in rows for row in rows_of_group])
