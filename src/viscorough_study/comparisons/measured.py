"""Tables of measured surfaces: lengths, power laws of their groups, kinetics, and elastic contacts."""

import json
from itertools import chain, product

import pandas as pd

from viscorough.contact.one_contact import contact_at
from viscorough.io.curves import unstack_curves
from viscorough.io.load_tables import SI_COLUMNS, rows_of_contacts
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
    "file": ("file of heights", None),
    **SI_COLUMNS,
}


def measured_contacts(scans):
    """Return the table of contacts of measured surfaces with an elastic half-space; its columns are `CONTACTS`.

    The rows have the numbers of `viscorough contact` with the same modulus and forces.

    scans : mappings with name, group, file, spacing, unit, preparation, forces [N], young_modulus [Pa] (None for no
        rows) and poisson_ratio
    """
    rows = []
    for scan in scans:
        if scan["young_modulus"] is None or not scan["forces"]:
            continue
        indenter = measured_indenter(scan["file"], **{name: scan[name] for name in ("spacing", "unit", "preparation")})
        modulus = scan["young_modulus"] / (1 - scan["poisson_ratio"] ** 2) / 4
        contacts = contact_at(indenter, force=sorted(scan["forces"]), shear_modulus=modulus)
        labels = {"scan": scan["name"], "group": scan["group"], "file": scan["file"]}
        rows += [labels | row for row in rows_of_contacts(contacts)[0]]
    return pd.DataFrame(rows, columns=list(CONTACTS))


def measured_tables(pool, curves, *, names, forces, fit, seed, **loading):
    """Return {"measured_scans", "measured_fits", "measured_kinetics": table} of measured surfaces.

    Their columns are `COLUMNS`, fit_table.COLUMNS and `KINETICS`.
    pool : pool of all scans; curves, names, forces : for each scan the Content of its curve, its name and its forces
        [N]
    fit : settings in section `scaling`; seed : of its bootstrap
    loading : media and times, as in `measured_motions`
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
    """Return tables of time, depth and velocity of a measured surface, one for each medium and constant force.

    curve : LoadingCurve of the surface; forces [N]
    media : mappings with a name and the keys of a medium; times : low, high [s], per_decade
    Times at which a depth lies beyond the end of the curve are omitted, and tables without a time are left out.
    """
    tables = []
    for (name, medium), force in product(named_media(media).items(), forces):
        if (reached := reached_times(curve.force[-1], force, medium, abscissa(**times))).size:
            motion = kinetics(curve, force, medium, reached)
            columns = {"time": motion.time, "depth": motion.depth, "velocity": motion.velocity}
            tables.append(pd.DataFrame({"medium": name, "force": force} | columns))
    return tables
