"""Kinetics of measured surfaces."""

import pandas as pd

from viscorough.viscous.correspondence import kinetics

COLUMNS = {
    "scan": ("name of the scan", None),
    "group": ("group of scans", None),
    "medium": ("name of the medium", None),
    "force": ("constant force F, from time 0 on", "N"),
    "time": ("time t since the force was applied", "s"),
    "depth": ("depth u", "m"),
    "velocity": ("velocity v = du/dt", "m s-1"),
}


def scan_kinetics(curve, media, forces, times):
    """Tables with COLUMNS without scan and group: depth and velocity under every force in every medium.

    curve : LoadingCurve [m]; media : {name: medium} in Pa and s; forces [N]; times : t > 0, increasing [s]
    Times at which the curve ends before the depth is reached are left out.
    """
    parts = []
    for name, medium in media.items():
        compliance = medium.creep_compliance(times)
        for force in forces:
            reached = times[force * compliance <= curve.force[-1]]
            if reached.size:
                motion = kinetics(curve, force, medium, reached)
                columns = {"time": motion.time, "depth": motion.depth, "velocity": motion.velocity}
                parts.append(pd.DataFrame(columns).assign(medium=name, force=force))
    return parts
