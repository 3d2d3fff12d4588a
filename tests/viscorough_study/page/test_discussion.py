"""Published results, as the page presents them."""

import pandas as pd

from support.documentation import ROOT
from viscorough_study.page.discussion import KNOWN, discussion
from viscorough_study.page.results import Number, Results

TABLE = pd.read_csv(ROOT / "docs/results/literature.csv")


def test_published_numbers_are_shown_next_to_ours():
    """Every source is listed once, with a statement of how it is known."""
    sources, quantities = discussion(Results({"literature": TABLE}, {})).values()
    for name, rows in quantities.items():
        for row in rows:
            table_rows = TABLE[(TABLE["quantity"] == name) & (TABLE["hurst"] == row["hurst"])]
            assert row["value"] == Number(table_rows["value"].iloc[0], "literature", "value", table_rows.index[0])
            stated = table_rows.dropna(subset="theirs_low")
            for (source, low, high), (i, theirs) in zip(row["theirs"], stated.iterrows(), strict=True):
                assert (low.value, low.row, high.row) == (theirs["theirs_low"], i, i)
                assert source.endswith(", as quoted") == (theirs["sure"] == "quoted")
                assert source.startswith(theirs["source"].split(",")[0].split(" and ")[0])
    assert sum(len(row["theirs"]) for rows in quantities.values() for row in rows) > 10
    named = [(source["source"], source["year"]) for source in sources]
    assert len(named) == len(set(named)) == len(TABLE.groupby(["source", "year"]))
    assert {source["known"] for source in sources} <= set(KNOWN.values())
