"""The calculator of the page: the numbers of the calibrated law for a script that computes as viscorough.estimates."""

import json

import numpy as np
from markupsafe import Markup

from viscorough.calibrated_law import calibration, depth_ratios

_COLUMNS = ("hurst", "beta", "beta_low", "beta_high", "zeta", "zeta_low", "zeta_high", "x_low", "x_high")


def calculator(section, script):
    """The section of the page with the numbers of the law and the script.

    section, script : texts of HTML and JavaScript
    """
    law = f'<script id="law" type="application/json">{json.dumps(law_table())}</script>'
    return Markup(f"{section}{law}\n<script>\n{script}</script>\n")


def law_table():
    """{column of the calibration, or ratio of depths: its values over ascending H}."""
    table, ratios = calibration(), depth_ratios()
    of_depth = {"ratio": "ratio", "ratio_low": "low", "ratio_high": "high"}
    return {name: table[name].tolist() for name in _COLUMNS} | {
        name: np.interp(table["hurst"], ratios["hurst"], ratios[column]).tolist() for name, column in of_depth.items()
    }
