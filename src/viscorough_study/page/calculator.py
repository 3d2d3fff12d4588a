"""Write the calculator of the page, which computes the results of viscorough.estimate in a browser."""

import json

from markupsafe import Markup

from viscorough.law.calibrated_law import ACROSS, interface_calibration
from viscorough.reference import one_element_stiffness


def calculator(folder):
    """Return the calculator as HTML: a section of the page, the constants of the penetration law, and a script.

    folder : folder of the templates of the page
    """
    section, script = ((folder / name).read_text("utf-8") for name in ("calculator.html", "calculator.js"))
    law = f'<script id="law" type="application/json">{json.dumps(law_table())}</script>'
    return Markup(f"{section}{law}\n<script>\n{script}</script>\n")


def law_table():
    """Return the constants of the calibrated penetration law, {name: list of values at ascending Hurst exponents}.

    The term g of the law, and the reduced time X, are defined in viscorough.law.calibrated_law. The constant
    one_element is the ratio g/X while a single element touches.
    """
    table = {name: values.tolist() for name, values in interface_calibration().items()}
    return table | {"one_element": [1 / one_element_stiffness(ACROSS) - 1] * len(table["hurst"])}
