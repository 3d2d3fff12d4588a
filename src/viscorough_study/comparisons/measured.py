"""Make the tables of measured surfaces: lengths, power laws of groups of scans, kinetics, and elastic contacts."""

import json
import logging
from functools import partial
from itertools import chain, product
from pathlib import Path

import pandas as pd

from viscorough import __version__
from viscorough.basics.elasticity import young_over_shear
from viscorough.io.contact_tables import (
    SI_COLUMNS,
    FileRows,
    digest_of_file,
    evaluated,
    lines_of_files,
    rows_at_loads,
)
from viscorough.io.curves import unstack_curves
from viscorough.viscous.kinetics import kinetics
from viscorough_study.comparisons.media_kinetics import named_media, reached_times
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.ensembles.measured import measured_indenter
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
CONTACTS = {
    "scan": ("name of the scan", None),
    "group": ("group of scans", None),
    **SI_COLUMNS,
}
# Settings for reading the file of a scan, and settings of the load. Together with the content of the file, they
# determine the rows of the scan in the table of contacts.
_READING = ("spacing", "unit", "preparation")
_LOADING = ("forces", "young_modulus", "poisson_ratio")


def measured_contacts(scans):
    """Return the table of contacts of measured surfaces with an elastic half-space; its columns are `CONTACTS`.

    For each scan the table has the numbers that the command `viscorough contact --grid-error` gives for the same
    modulus and forces. A scan that cannot be evaluated has one row, with the reason in the column `error`.

    scans : mappings with name, group, file, spacing, unit, preparation, forces [N], young_modulus [Pa] and
        poisson_ratio. A scan without forces, or with the modulus None, has no rows
    """
    lines = []
    for scan in scans:
        if scan["young_modulus"] is None or not scan["forces"]:
            continue
        result = _evaluated_scan(scan)
        if result.error:
            logging.warning("%s: %s", scan["file"], result.error)
        labels = {"scan": scan["name"], "group": scan["group"]}
        lines += [labels | line for line in lines_of_files([result])]
    return pd.DataFrame(lines, columns=list(CONTACTS))


def _evaluated_scan(scan):
    """Solve the elastic contact of one scan under all its forces, and return its FileRows (io.contact_tables)."""
    reading, loading = ({name: scan[name] for name in names} for names in (_READING, _LOADING))
    modulus = scan["young_modulus"] / young_over_shear(scan["poisson_ratio"])
    settings = f"{__version__} {json.dumps(reading | loading, sort_keys=True)}"
    return evaluated(
        FileRows(str(scan["file"]), digest_of_file(scan["file"], settings)),
        Path(scan["file"]),
        partial(measured_indenter, scan["file"], **reading),
        partial(rows_at_loads, force=sorted(scan["forces"]), shear_modulus=modulus, grid_error=True),
    )


def measured_tables(pool, curves, *, names, forces, fit, seed, **loading):
    """Return the tables of scans, fits and kinetics of measured surfaces, as {name: pandas.DataFrame}.

    The names are "measured_scans", "measured_fits" and "measured_kinetics". The columns are `COLUMNS`,
    fit_table.COLUMNS and `KINETICS`, in this order.
    pool : pool of all scans (ensembles.pool)
    curves : for each scan, the Content of the file that stores its loading curve
    names, forces : for each scan, its name, and a list of its forces [N]
    fit : settings of the fits (section `scaling`); seed : seed of the bootstrap of the fits
    loading : the arguments `media` and `times` of `measured_motions`
    """
    scans, motions = [], [pd.DataFrame(columns=list(KINETICS))]
    for name, batch, scan_forces in zip(names, curves, forces, strict=True):
        (curve,), (settings,) = unstack_curves(batch), json.loads(batch.attributes["settings"])["ensembles"]
        labels = {"scan": name, "group": settings["group"]}
        scans.append(labels | {"file": settings["file"]} | settings["lengths"])
        motions += [motion.assign(**labels) for motion in measured_motions(curve, scan_forces, **loading)]
    groups = ensembles(pool, "group").items()
    fits = [fit_rows(ensemble, source="measured", case_group=group, seed=seed, **fit) for group, ensemble in groups]
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
