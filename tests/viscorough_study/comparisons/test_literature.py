"""Published results, compared with those of this study."""

import numpy as np
import pandas as pd
import pytest
import yaml

from support.study import HURST, ROOT, SHOWN, evidence
from viscorough import reference
from viscorough_study.comparisons.literature import COLUMNS, literature, persson_u0

ENTRIES = yaml.safe_load((ROOT / "resources/literature/stiffness.yaml").read_text(encoding="utf-8"))
INTERFACE = pd.DataFrame(
    [
        (source, hurst, 257, u0, u0 - 0.1, u0 + 0.1)
        for source, u0 in (("discs", 0.5), ("lines", 0.7))
        for hurst in HURST
    ],
    columns=["source", "hurst", "across", "u0", "u0_low", "u0_high"],
)


REDUCTION = pd.DataFrame(
    [(hurst, x, *(x * hurst + end for end in (0, -0.001, 0.001) * 2)) for hurst in HURST for x in (1e-3, 1e-2, 0.1)],
    columns=["hurst", "x", *(f"{name}_ratio{end}" for name in ("area", "gap") for end in ("", "_low", "_high"))],
)


@pytest.fixture
def table():
    scaling = evidence().tables["scaling"].assign(beta_low=0.1, beta_high=0.7)
    return literature(scaling, INTERFACE, REDUCTION, entries=ENTRIES, conventions=SHOWN).round({"low": 9, "high": 9})


def of(table, quantity, place=""):
    return table[(table["quantity"] == quantity) & table["place"].str.contains(place)]


def test_table_compares_exponents_and_lines_with_published_ones(table):
    assert list(table) == list(COLUMNS)
    assert table["year"].is_monotonic_increasing
    alpha = of(table, "alpha")
    assert set(alpha["hurst"]) == set(HURST)
    np.testing.assert_allclose(alpha["value"], reference.exponent_alpha(alpha["hurst"]), atol=0.02)
    assert (alpha[["low", "high"]] == [0.3, 0.9]).all(axis=None)  # 1 minus the ends of β
    law, stated = of(table, "alpha", "86, 026710"), of(table, "alpha", "108, 104301")
    np.testing.assert_allclose(law["theirs_low"], 1 / (1 + law["hurst"]))
    assert set(zip(stated["theirs_low"], stated["theirs_high"], strict=True)) == {(0.51, 0.77)}
    for name in ("area", "gap"):
        rows = of(table, name, "Tribol. Lett.")
        np.testing.assert_allclose(rows["value"], 0.01 * rows["hurst"])  # at one force
        np.testing.assert_allclose(rows["high"] - rows["low"], 0.002)


def test_table_compares_u0_with_published_values_and_perssons_law(table):
    u0, gamma = of(table, "u0"), of(table, "gamma")
    assert set(zip(u0["value"], u0["low"], u0["high"], strict=True)) == {(0.5, 0.4, 0.6)}
    law, stated = of(table, "u0", "99, 125502"), of(table, "u0", "87, 062809")
    without = [persson_u0(hurst, 257 / 2) for hurst in law["hurst"]]
    np.testing.assert_allclose(law[["theirs_low", "theirs_high"]], np.outer(without, [0.4, 0.45]))
    assert set(zip(stated["theirs_low"], stated["theirs_high"], strict=True)) == {(0.4, 0.4)}
    np.testing.assert_allclose(gamma["value"] * without, 0.5)
    assert of(table, "u0", "0810.0950")["theirs_low"].isna().all()  # "of the order of h" is no number


# ---- Persson's law
