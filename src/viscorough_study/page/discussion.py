"""Published results and those of this run, as the page presents the table `literature`."""

from viscorough_study.comparisons.literature import cited

# {quantity of the table: its name on the page}
QUANTITIES = {
    "alpha": "α, exponent of the stiffness in the force; here 1 − β of discs",
    "u0": "u₀/h, decay length of the pressure with the separation; here the plateau of the interface",
    "gamma": "γ, factor on Persson's law for u₀; here the one that gives our u₀/h",
    "area": "contact of a line (MDR) over that of its disc, at X = 0.01",
    "gap": "mean gap of a line (MDR) over that of its disc, at X = 0.01",
}
KNOWN = {
    "abstract": "abstract read",
    "the paper": "as the paper quotes it",
    "quoted": "as later work quotes it",
    "not verified": "not verified",
}


def discussion(results):
    """Sources by year, and for each quantity the values of this study and of the literature by Hurst exponent."""
    table = results.tables["literature"]
    return {
        "sources": [
            {name: row[name] for name in ("source", "place", "year", "when", "statement")}
            | {"known": KNOWN[row["sure"]]}
            for _, row in table.drop_duplicates(["source", "year"]).iterrows()
        ],
        "quantities": {name: rows for name in QUANTITIES if (rows := _rows(results, name))},
    }


def _credit(row):
    """Citation of a number, marked if it is quoted from later work."""
    return cited(row["source"], row["year"]) + (", as quoted" if row["sure"] == "quoted" else "")


def _rows(results, quantity):
    """[{hurst, value, low, high, theirs: [(citation, low, high)]}] by ascending H."""
    rows = results.rows("literature", quantity=quantity).dropna(subset="hurst")
    comparison = []
    for hurst, sources in rows.groupby("hurst"):
        theirs = [
            (_credit(row), *results.numbers("literature", i, "theirs_low", "theirs_high").values())
            for i, row in sources.dropna(subset="theirs_low").iterrows()
        ]
        ours = results.numbers("literature", sources.index[0], "value", "low", "high")
        comparison.append({"hurst": hurst, "theirs": theirs} | ours)
    return comparison
