"""What others found, with the numbers of this study beside it."""

import numpy as np
import pandas as pd
import pytest
import yaml

from support.study import HURST, ROOT, SHOWN, evidence
from viscorough import reference
from viscorough_study.literature import COLUMNS, literature

ENTRIES = yaml.safe_load((ROOT / "resources/literature/stiffness.yaml").read_text(encoding="utf-8"))
INTERFACE = pd.DataFrame(
    [
        (source, group, hurst, average, u0, u0 - 0.1, u0 + 0.1)
        for source, group, u0 in (("discs", "base", 0.5), ("discs", "sizes", 0.6), ("lines", "lines", 0.7))
        for hurst in HURST
        for average in ("arithmetic", "geometric")
    ],
    columns=["source", "case_group", "hurst", "average", "u0", "u0_low", "u0_high"],
)


def test_numbers_of_this_study_stand_beside_those_of_others():
    scaling = evidence().tables["scaling"].assign(beta_low=0.1, beta_high=0.7)
    table = literature(ENTRIES, scaling, INTERFACE, SHOWN).round({"low": 9, "high": 9})
    assert list(table) == list(COLUMNS)
    assert table["year"].is_monotonic_increasing
    alpha, u0 = (table[table["quantity"] == name] for name in ("alpha", "u0"))
    assert set(alpha["hurst"]) == set(u0["hurst"]) == set(HURST)
    np.testing.assert_allclose(alpha["value"], reference.exponent_alpha(alpha["hurst"]), atol=0.02)
    assert (alpha["low"] == 0.3).all()  # 1 less the upper end of β
    assert (alpha["high"] == 0.9).all()
    law = alpha[alpha["place"].str.contains("86, 026710")]
    np.testing.assert_allclose(law["theirs_low"], 1 / (1 + law["hurst"]))
    stated = alpha[alpha["place"].str.contains("108, 104301")]
    assert set(zip(stated["theirs_low"], stated["theirs_high"], strict=True)) == {(0.51, 0.77)}
    assert set(zip(u0["value"], u0["low"], u0["high"], strict=True)) == {(0.5, 0.4, 0.6)}
    assert table.loc[table["quantity"] == "none", ["hurst", "value", "theirs_low"]].isna().all(axis=None)


def test_sources_stay_without_numbers_of_this_study():
    scaling = evidence().tables["scaling"]
    table = literature(ENTRIES, scaling.iloc[:0], INTERFACE.iloc[:0], SHOWN)
    assert len(table) == len(ENTRIES)
    assert table["value"].isna().all()


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda entry: entry["source"])
def test_no_number_is_taken_from_memory(entry):
    assert entry["when"] == ("before" if entry["year"] < 2013 else "after")
    assert entry["sure"] in {"abstract", "the paper", "memory"}
    assert entry["sure"] != "memory" or not {"theirs", "law"} & set(entry)
