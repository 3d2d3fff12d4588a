"""Criteria of claims on the methods: the factor Γ, the line of the MDR, counts and time."""

import numpy as np

from viscorough.surfaces import cut_disc
from viscorough_study.fits.intervals import NO_INTERVAL, UNDEFINED, difference
from viscorough_study.verdicts.evidence import exact, judged

WEEKS_IN_MINUTES = 7 * 24 * 60  # ratio of "several weeks" to "a few minutes"
SMALL_ERROR = 0.01  # of the velocity, at which contact problems are counted


def gamma(evidence, tolerance):
    """Depth of direct integrations in time over the elastic depth, against the factor of Eq. 8."""
    for name, rows in evidence.tables["direct"].groupby("case", sort=False):
        ratio, factor = rows["depth_ratio"], rows["with_gamma"].iloc[0]
        yield exact(name, ratio.median(), factor, (np.abs(ratio - factor) <= tolerance).all(), ratio)


def line_spectrum(evidence, tolerance):
    """λ at the largest Hurst exponent over λ at the smallest, with the smallest and the largest λ/π of all.

    Where λ varies with H by more than the tolerance, it is no constant, and so not π. The two λ are independent, so the
    half-widths of the intervals of their logarithms add in quadrature.
    """
    fits = evidence.fits("discs")[["lambda", "lambda_low", "lambda_high", "realizations"]].dropna()
    if len(fits) < 2:
        yield judged("λ over H", UNDEFINED, np.nan, None)
        return
    logarithms = np.log(fits.drop(columns="realizations").to_numpy())
    logarithmic, widest = difference(logarithms[0], logarithms[-1]), np.log1p(tolerance)
    number = min(fits["realizations"].min(), evidence.fits("lines")["realizations"].min())
    constant = evidence.within(logarithmic, -widest, widest, realizations=number)
    met = None if constant is None else not constant
    name = f"λ at H = {fits.index[-1]:g} over λ at H = {fits.index[0]:g}; least and largest λ/π"
    extremes = fits["lambda"].min() / np.pi, fits["lambda"].max() / np.pi
    yield judged(name, np.exp(logarithmic), np.nan, met, extremes=extremes)


def bodies_of_revolution(evidence, tolerance):
    """Error of the reduction on the finest grid, with the smallest and largest error over all grids."""
    validation = evidence.tables["validation"]
    rows = validation[validation["case"].str.endswith("_reduction")]
    for (case, quantity), grids in rows.groupby(["case", "quantity"], sort=False):
        error = grids.sort_values("elements")["error"]
        name = f"{case.removesuffix('_reduction')}, {quantity}"
        yield exact(name, error.iloc[-1], 0.0, error.iloc[-1] <= tolerance, error)


def elements(evidence, tolerance):
    """Number of elements of a disc as large as the paper's; least and largest: without and with those on the rim."""
    across, paper_count = (evidence.paper_value("boundary_elements", name) for name in ("elements_across", "elements"))
    count = np.isfinite(cut_disc(np.zeros((across, across)), across)).sum()
    x = np.arange(across) - (across - 1) / 2
    on_rim = (x[:, None] ** 2 + x**2 == ((across - 1) / 2) ** 2).sum()
    met = abs(count - paper_count) <= tolerance
    yield exact(f"{across} across", count, paper_count, met, (count - on_rim, count))


def contact_problems(evidence, tolerance):
    """Number of contact problems needed for the velocity, over the number of elements, each a change of the contact.

    The problems are the levels of the elastic loading path, at the loosest tolerance with an error below `SMALL_ERROR`,
    on a disc as large as the paper's; the value is the largest over Hurst exponents.
    """
    levels = _rough_discs(evidence).query("method == 'path, automatic levels' and error <= @SMALL_ERROR")
    ratios = levels.groupby("hurst")["steps"].min().to_numpy() / evidence.paper_value("boundary_elements", "elements")
    met = (np.abs(np.log(ratios)) <= np.log(tolerance)).all()
    yield exact("of a disc", max(ratios, default=np.nan), 1.0, met, ratios)


def computing_time(evidence, tolerance):
    """Time of boundary elements over that of lines, at the numbers that the paper states.

    Boundary elements solve a contact problem for every contact event of every indentation, as explicit steps do; the
    reduction treats every point of every line. The time of each is from the table of methods, for a disc as large as
    the paper's. The ratio varies with the machine and its load, and would jump between runs if rounded to a power of
    ten.
    """
    indentations = [evidence.paper_value("boundary_elements", name) for name in ("combinations", "realizations_min")]
    counts = [ensemble["contact_count"].max("abscissa").values for ensemble in evidence.whole.values()]
    problems = np.prod(indentations) * np.median(np.concatenate(counts))
    names = "hurst_count", "realizations", "points"
    points = np.prod([float(evidence.paper_value("reduction", name)) for name in names])
    # The time per step or point of a method is that of its run with the most of them.
    methods = _rough_discs(evidence).sort_values("value", ascending=False, kind="stable").drop_duplicates("method")
    times = (methods["wall_s"] / methods["value"]).set_axis(methods["method"])
    explicit, reduction = times.reindex(["explicit, logarithmic steps", "MDR"])  # nan if one was not measured
    ratio = problems * explicit / (points * reduction)
    met = bool(1 / tolerance <= ratio / WEEKS_IN_MINUTES <= tolerance)
    yield judged("ratio of the times", (ratio, *NO_INTERVAL), WEEKS_IN_MINUTES, met)


def _rough_discs(evidence):
    """Rows of the table of methods on rough discs as large as the paper's."""
    methods, across = evidence.tables["methods"], evidence.paper_value("boundary_elements", "elements_across")
    return methods[methods["hurst"].notna() & (methods["elements"] == across)]
