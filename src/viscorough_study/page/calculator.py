"""Write the calculator of the page, which gives the estimates of viscorough.estimate in a browser."""

import json

from markupsafe import Markup

from viscorough.law.calibrated_law import ACROSS, interface_calibration
from viscorough.reference import one_element_stiffness


def calculator(section, script):
    """Return the calculator as HTML: its section of the page, the numbers of the law, and the script.

    section : HTML of the section; script : JavaScript that calculates
    """
    law = f'<script id="law" type="application/json">{json.dumps(law_table())}</script>'
    return Markup(f"{section}{law}\n<script>\n{script}</script>\n")


def law_table():
    """Return the numbers of the calibrated law, {name: list of values at ascending H}.

    one_element : constant c of g = cX while a single element touches (viscorough.law.calibrated_law)
    """
    table = {name: values.tolist() for name, values in interface_calibration().items()}
    return table | {"one_element": [1 / one_element_stiffness(ACROSS) - 1] * len(table["hurst"])}
