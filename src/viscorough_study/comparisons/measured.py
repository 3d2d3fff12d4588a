"""Measured surfaces as indenters in metres, and their tables: lengths, power laws of their groups, and kinetics."""

import json
from itertools import product

import numpy as np
import pandas as pd

from viscorough.indenter import Indenter
from viscorough.io.curves import unstack_curves
from viscorough.io.heights import read_heights
from viscorough.units import metres
from viscorough_study.comparisons.media_kinetics import motion_on_curve, named_media
from viscorough_study.ensembles.averages import abscissa
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
KINETICS = {
    "scan": ("name of the scan", None),
    "group": ("group of scans", None),
    "medium": ("name of the medium", None),
    "force": ("constant force F, from time 0 on", "N"),
    "time": ("time t since the force was applied", "s"),
    "depth": ("depth u", "m"),
    "velocity": ("velocity v = du/dt", "m s-1"),
}


def measured_indenter(file, *, spacing, unit, preparation):
    """The prepared Indenter of a scan, in metres.

    spacing : [], as the file states; [of both directions] or [between columns, between rows]
    unit : of the heights, None as the file states; preparation : further arguments of read_heights
    Raises ValueError if the unit of length is not known.
    """
    both = {0: None, 1: spacing[:1], 2: spacing}[len(spacing)]
    spacing = both[0] if both and len(both) == 1 else both
    indenter = read_heights(file, spacing, unit=unit, **preparation)
    if indenter.length_unit == "1":
        raise ValueError(f"{file}: states no unit of length; measured.unit in the settings is needed")
    factor = metres(indenter.length_unit)
    spacings = indenter.spacing * factor, indenter.row_spacing * factor
    return Indenter(indenter.heights * factor, *spacings, length_unit="m")


def lengths(indenter):
    """{column: value} of an indenter: spacings, rms height and slope, diameter of the circle of equal area."""
    area = indenter.elements * indenter.spacing * indenter.row_spacing
    return {
        "elements": indenter.elements,
        "spacing": indenter.spacing,
        "row_spacing": indenter.row_spacing,
        "rms": float(np.nanstd(indenter.heights, dtype=float)),
        "rms_slope": indenter.rms_slope,
        "diameter": 2 * np.sqrt(area / np.pi),
    }


def measured_tables(pool, curves, *, media, times, fit, seed, **of_scans):
    """{"measured_scans", "measured_fits", "measured_kinetics": table} of measured surfaces.

    Their columns are `COLUMNS`, those of fit_table and `KINETICS`.
    pool : of all scans; curves : Content of the curve of each; of_scans : names, and forces [N] of each scan
    media : mappings with a name and the keys of a medium; times : low, high [s], per_decade
    fit : settings in section `scaling`
    """
    asked = {"media": named_media(media), "times": abscissa(**times)}
    scans, motions = scans_and_kinetics(curves, **asked, **of_scans)
    fits = group_fits(ensembles(pool, "group"), seed=seed, **fit)
    return {"measured_scans": scans, "measured_fits": fits, "measured_kinetics": motions}


def scans_and_kinetics(batches, *, names, forces, media, times):
    """Tables with the columns of `COLUMNS` and of `KINETICS`.

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
