"""Make the tables of measured surfaces: lengths, power laws of groups of scans, and kinetics."""

from itertools import chain, product

import pandas as pd

from viscorough.viscous.kinetics import kinetics
from viscorough_study.comparisons.media_kinetics import named_media, reached_times
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


def measured_tables(pool, curves, *, names, forces, fit, seed, **loading):
    """Return the tables of scans, fits and kinetics of measured surfaces, as {name: pandas.DataFrame}.

    The names are "measured_scans", "measured_fits" and "measured_kinetics". The columns are `COLUMNS`,
    fit_table.COLUMNS and `KINETICS`, in this order.
    pool : pool of all scans (ensembles.pool)
    curves : for each scan, the result of ensembles.curve_files.read_curves for the file of its loading curve
    names, forces : for each scan, its name, and a list of its forces [N]
    fit : settings of the fits (section `scaling`); seed : seed of the bootstrap of the fits
    loading : the arguments `media` and `times` of `measured_motions`
    """
    scans, motions = [], [pd.DataFrame(columns=list(KINETICS))]
    for name, (((_, curve),), (settings,)), scan_forces in zip(names, curves, forces, strict=True):
        labels = {"scan": name, "group": settings["group"]}
        scans.append(labels | {"file": settings["file"]} | settings["lengths"])
        motions += [motion.assign(**labels) for motion in measured_motions(curve, scan_forces, **loading)]
    groups = ensembles(pool, "group").items()
    fits = [fit_rows(ensemble, source="measured", group=group, seed=seed, **fit) for group, ensemble in groups]
    return {
        "measured_scans": pd.DataFrame(scans),
        "measured_fits": pd.DataFrame(chain.from_iterable(fits)),
        "measured_kinetics": pd.concat(motions[1:] or motions, ignore_index=True)[list(KINETICS)],
    }


def measured_motions(curve, forces, *, media, times):
    """Return tables of time, depth and velocity of a measured surface, one table for each medium and constant force.

    curve : LoadingCurve of the surface; forces : constant forces [N]
    media : mappings, each with a name and the parameters of a medium (io.medium_files)
    times : {"low", "high", "per_decade"}, the range [s] and the number per decade of the times
    Times at which the depth lies beyond the end of the curve are omitted. If no time remains, there is no table.
    """
    tables = []
    for (name, medium), force in product(named_media(media).items(), forces):
        if (reached := reached_times(curve.force[-1], force, medium, abscissa(**times))).size:
            motion = kinetics(curve, force, medium, reached)
            columns = {"time": motion.time, "depth": motion.depth, "velocity": motion.velocity}
            tables.append(pd.DataFrame({"medium": name, "force": force} | columns))
    return tables
