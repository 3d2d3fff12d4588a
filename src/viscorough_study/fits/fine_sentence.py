"""State in one sentence what the published exponents of fine grids show (`make fine-grids`, fits.fine_grids)."""

from pathlib import Path

from viscorough_study.run.paper_data import read_records

# The published table in the folder of the project.
PUBLISHED = "resources/published/fine_exponents.csv"
TOLERANCE = 0.03  # largest |β − H/(1 + H)| of the interval of the limit; fixed before the run


def judged_rows(project):
    """Return the rows of the published table by which the limits of β are judged, as [{column: value}].

    There is one row for each Hurst exponent, of vt/h on the finest grid. project : folder of the project
    """
    rows = read_records(Path(project) / PUBLISHED)
    return [row for row in rows if row["judged"] and row["quantity"] == "whole"]


def fine_grids_sentence(rows):
    """Return the finding on fine grids as a sentence of plain text; rows : result of `judged_rows`.

    >>> row = {"hurst": 0.1, "x_low": 1e-3, "across": 4097, "beta": 0.151, "beta_low": 0.115, "beta_high": 0.187}
    >>> rows = [{"hurst": 0.4, "finding": "within"}, row | {"finding": "open"}]
    >>> print(fine_grids_sentence(rows).replace("; ", ";\\n"))
    On fine grids and at small X, β comes within 0.03 of H/(1 + H) at H = 0.4;
    at H = 0.1 it is 0.15 ± 0.04 on 4097 at X = 0.001 to 0.01, and the limit is open.
    """
    within = [f"{row['hurst']:g}" for row in rows if row["finding"] == "within"]
    parts = [f"β comes within {TOLERANCE:g} of H/(1 + H) at {f'H = {listed(within)}' if within else 'no H'}"]
    for row in rows:
        if row["finding"] != "within":
            half = (row["beta_high"] - row["beta_low"]) / 2
            parts.append(
                f"at H = {row['hurst']:g} it is {row['beta']:.2f} ± {half:.2f} on {row['across']} at X = "
                f"{row['x_low']:.1g} to {10 * row['x_low']:.1g}, and the limit is {row['finding']}"
            )
    return "On fine grids and at small X, " + "; ".join(parts) + "."


def listed(texts):
    """Return texts as a list in prose: a, b and c."""
    return " and ".join(filter(None, [", ".join(texts[:-1]), *texts[-1:]]))
