"""Collect published results and the corresponding results of this run, from the table `literature`."""

from viscorough_study.comparisons.literature import cited

# {quantity in the table `literature`: its description on the page}
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
}


def discussion(results):
    """Return the published sources, and the values of each quantity in this study and in the literature.

    sources : list with one row of the table for each source, sorted by year
    quantities : {quantity: list with a dict for each Hurst exponent}. The dict has the value of this study with its
        interval, and as `theirs` the list of published ranges, [(citation, low, high)]
    """
    table, quantities = results.tables["literature"], {name: [] for name in QUANTITIES}
    for (name, hurst), rows in table.dropna(subset="hurst").groupby(["quantity", "hurst"]):
        theirs = [
            (_credit(row), *(results.number("literature", i, end) for end in ("theirs_low", "theirs_high")))
            for i, row in rows.dropna(subset="theirs_low").iterrows()
        ]
        ours = results.record("literature", rows.index[0])
        quantities[name].append(ours | {"hurst": hurst, "theirs": theirs})
    sources = table.drop_duplicates(["source", "year"]).assign(known=table["sure"].map(KNOWN))
    return {
        "sources": sources.to_dict("records"),
        "quantities": {name: rows for name, rows in quantities.items() if rows},
    }


def _credit(row):
    """Return the citation of a published number, with "as quoted" if the number is known only from later work."""
    return cited(row["source"], row["year"]) + (", as quoted" if row["sure"] == "quoted" else "")
