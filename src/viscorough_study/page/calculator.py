"""Write the numbers of the calibrated law for the calculator of the page, which repeats viscorough.estimate."""

import json

from markupsafe import Markup

from viscorough.law.calibrated_law import ACROSS, interface_calibration
from viscorough.reference import one_element_stiffness


def calculator(section, script):
    """Return the section of the page, with the numbers of the law and the script.

    section, script : texts of HTML and JavaScript
    """
    law = f'<script id="law" type="application/json">{json.dumps(law_table())}</script>'
    return Markup(f"{section}{law}\n<script>\n{script}</script>\n")


def law_table():
    """Return {number of the law: its values over ascending H}."""
    table = {name: values.tolist() for name, values in interface_calibration().items()}
    return table | {"one_element": [1 / one_element_stiffness(ACROSS) - 1] * len(table["hurst"])}
