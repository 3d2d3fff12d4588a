"""Fit β and ζ of the discs in every convention that the paper leaves open, beside the two readings of the study.

The conventions are the surfaces (their period, the corners of the spectrum, the kind of amplitudes), the rms height h,
the kind of mean, and the window of X. ζ belongs to the law with the exponent H/(1 + H) and the factor 1/Γ(2 − α), as
the paper's Eq. 11; the table has its ratio to 2 − H.
"""

import pandas as pd

from viscorough import reference
from viscorough_study.ensembles.pool import ensembles
from viscorough_study.fits.conventions import CONTROL, convert_zeta
from viscorough_study.fits.fit_table import fit_rows
from viscorough_study.fits.intervals import described

_RATIO = {f"zeta_fixed{end}": f"zeta_ratio{end}" for end in ("", "_low", "_high")}
COLUMNS = {
    "reading": (
        "reading of the surfaces: A (period L, h of the disc), B (longer period, h of the square), or none",
        "",
    ),
    "surfaces": ("base, longer_period or name of the variant of the surfaces", ""),
    "hurst": ("Hurst exponent H", "1"),
    "rms_convention": ("where the rms height h is measured", ""),
    "average": ("mean over the realizations at fixed X", ""),
    "window_rule": ("rule of the window of the fit", ""),
    "realizations": ("realizations in the ensemble", "1"),
    **described("beta", "exponent β of vt/h in X", ends="of the 95 % interval of β"),
    **described("zeta_ratio", "ζ of the law with β = H/(1 + H) and Γ over 2 − H (Eq. 11)", ends="of its 95 % interval"),
    "residual": ("root mean square of ln(vt/h) less the law with β = H/(1 + H)", "1"),
}


def sensitivities(*pools, **fit):
    """Fit every ensemble of discs in every convention; return a pandas.DataFrame with the columns `COLUMNS`.

    pools : pools of the loading curves of discs (viscorough_study.ensembles.pool); the control is left out
    fit : arguments of fits.fit_table.fit_rows: limits of region (b), resamples and seed of the bootstrap
    """
    rows = []
    for pool in pools:
        for (group, _), ensemble in ensembles(pool, "group", "hurst").items():
            if group != CONTROL:
                rows += fit_rows(ensemble, source="discs", group=group, **fit)
    table = convert_zeta(pd.DataFrame(rows), "with").rename(columns={"group": "surfaces"})
    ratios = {ratio: table[zeta] / reference.zeta_viscous(table["hurst"]) for zeta, ratio in _RATIO.items()}
    return table.assign(**ratios, residual=table["residual_fixed"])[list(COLUMNS)]
