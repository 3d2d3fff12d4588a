"""Rows of tables of fits."""


def fits(table, shown, **wanted):
    """Rows of the scaling table under the conventions shown, replaced or added to by those wanted; by ascending H.

    Rows without a region (b), which have no exponent, are left out.
    """
    for column, value in (shown | wanted).items():
        table = table[table[column] == value]
    return table.dropna(subset="beta").sort_values("hurst")
