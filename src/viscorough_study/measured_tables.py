"""The tables of measured surfaces: the scans, the power laws of their groups, and their kinetics."""

import json
from itertools import product

import pandas as pd

from viscorough.io.curves import unstack_curves
from viscorough_study.fit_table import fit_rows
from viscorough_study.media_kinetics import motion_on_curve

KINETICS = {
    "scan": ("name of the scan", None),
    "group": ("group of scans", None),
    "medium": ("name of the medium", None),
    "force": ("constant force F, from time 0 on", "N"),
    "time": ("time t since the force was applied", "s"),
    "depth": ("depth u", "m"),
    "velocity": ("velocity v = du/dt", "m s-1"),
}


def scans_and_kinetics(batches, *, names, forces, media, times):
    """Tables with the columns of viscorough_study.measured and of `KINETICS`.

    batches : Content of the curve of each scan; names : of the scans; forces : of each scan [N]
    media : {name: medium} in Pa and s; times : t > 0, increasing [s]
    """
    scans, motions = [], [pd.DataFrame(columns=list(KINETICS))]
    for name, batch, of_scan in zip(names, batches, forces, strict=True):
        (curve,), settings = unstack_curves(batch), json.loads(batch.attributes["settings"])
        same = {"scan": name, "group": settings["group"]}
        scans.append(same | {"file": settings["file"]} | settings["lengths"])
        motions += [part.assign(**same) for part in _motions(curve, media, of_scan, times)]
    return pd.DataFrame(scans), pd.concat(motions[1:] or motions, ignore_index=True)[list(KINETICS)]


def _motions(curve, media, forces, times):
    """Depth and velocity under every force in every medium; curve : LoadingCurve [m].

    Times at which the curve ends before the depth is reached are left out.
    """
    for (name, medium), force in product(media.items(), forces):
        if motion := motion_on_curve(curve, force, medium, times):
            columns = {"time": motion.time, "depth": motion.depth, "velocity": motion.velocity}
            yield pd.DataFrame(columns).assign(medium=name, force=force)


def group_fits(groups, **how):
    """Table of the power laws of groups, with the columns of `fit_table`.

    groups : {name: ensemble dataset of its scans}; how : resamples, seed and limits of fit_table.fit_rows
    """
    rows = [fit_rows(ensemble, source="measured", case_group=group, **how) for group, ensemble in groups.items()]
    return pd.DataFrame([row for rows_of_group in rows for row in rows_of_group])
