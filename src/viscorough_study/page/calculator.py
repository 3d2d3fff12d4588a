"""Calculator of the page: the calibrated law as numbers for a script that mirrors viscorough.estimates."""

import json

from markupsafe import Markup

from viscorough.calibrated_law import X_HIGH, interface_calibration

# {number of the law in the script: column of the calibration}
_COLUMNS = {
    **{name: name for name in ("hurst", "exponent", "peak", "peak_x", "error")},
    **{"offset": "depth_offset", "offset_low": "depth_low", "offset_high": "depth_high", "x_low": "law_low"},
}


def calculator(section, script):
    """Section of the page, with the numbers of the law and the script.

    section, script : texts of HTML and JavaScript
    """
    law = f'<script id="law" type="application/json">{json.dumps(law_table())}</script>'
    return Markup(f"{section}{law}\n<script>\n{script}</script>\n")


def law_table():
    """{number of the law: its values over ascending H}."""
    table = {name: interface_calibration()[column].tolist() for name, column in _COLUMNS.items()}
    return table | {"x_high": [X_HIGH] * len(table["hurst"])}
