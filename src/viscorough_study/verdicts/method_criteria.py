"""Judge claims on the methods: the factor Γ, the line of the MDR, and counts."""

import numpy as np

from viscorough.surfaces.self_affine import cut_disc
from viscorough_study.fits.intervals import UNDEFINED, difference
from viscorough_study.verdicts.evidence import exact, judged

SMALL_ERROR = 0.01  # error of the velocity for the count of explicit steps
HUNDREDS = 100  # smallest number of contact problems that is "some hundreds"
EXPLICIT = "explicit, logarithmic steps"  # method of the table of methods that solves a contact problem in every step


def gamma(evidence, tolerance):
    """Compare the depth of direct integrations in time, over the elastic depth, with the factor of Eq. 8."""
    for name, rows in evidence.tables["direct"].groupby("case", sort=False):
        ratio, factor = rows["depth_ratio"], rows["with_gamma"].iloc[0]
        yield exact(name, ratio.median(), factor, (np.abs(ratio - factor) <= tolerance).all(), ratio)


def line_spectrum(evidence, tolerance):
    """Yield λ at the largest Hurst exponent over λ at the smallest, with the smallest and the largest λ/π of all.

    If λ varies with H by more than the tolerance, it is not constant, and so not π. The two λ are independent, so the
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
    """Yield the error of the reduction on the finest grid, with the smallest and largest error over all grids."""
    validation = evidence.tables["validation"]
    rows = validation[validation["case"].str.endswith("_reduction")]
    for (case, quantity), grids in rows.groupby(["case", "quantity"], sort=False):
        error = grids.sort_values("elements")["error"]
        name = f"{case.removesuffix('_reduction')}, {quantity}"
        yield exact(name, error.iloc[-1], 0.0, error.iloc[-1] <= tolerance, error)


def elements(evidence, tolerance):
    """Yield the elements of a disc as large as the paper's; least and largest: without and with elements on the rim."""
    across, paper_count = (evidence.paper_value("boundary_elements", name) for name in ("elements_across", "elements"))
    count = np.isfinite(cut_disc(np.zeros((across, across)), across)).sum()
    x = np.arange(across) - (across - 1) / 2
    on_rim = (x[:, None] ** 2 + x**2 == ((across - 1) / 2) ** 2).sum()
    met = abs(count - paper_count) <= tolerance
    yield exact(f"{across} across", count, paper_count, met, (count - on_rim, count))


def contact_problems(evidence, tolerance):
    """Yield the contact problems of one indentation: changes of the contact, and steps to a given accuracy.

    Every element that comes into contact is a change; the extremes are over the discs. The number of steps is the
    smallest of explicit integration with an error of the velocity below `SMALL_ERROR`; the extremes are over all rough
    discs that reach this error, of any number of elements.
    """
    counts = [ensemble["contact_count"].max("abscissa").values for ensemble in evidence.whole.values()]
    methods = evidence.tables["methods"]
    steps = methods[methods["hurst"].notna()].query("method == @EXPLICIT and error <= @SMALL_ERROR")
    numbers = {
        "changes of the contact": np.concatenate(counts),
        f"steps to {SMALL_ERROR:.0%}": steps.groupby(["hurst", "elements"])["steps"].min().to_numpy(),
    }
    for name, values in numbers.items():
        if not values.size:
            yield judged(name, UNDEFINED, np.nan, None)
            continue
        met = ((values >= HUNDREDS) & (values <= tolerance)).all()
        yield exact(name, np.median(values), np.nan, met, values)


def _rough_discs(evidence):
    """Return rows of the table of methods on rough discs as large as the paper's."""
    methods, across = evidence.tables["methods"], evidence.paper_value("boundary_elements", "elements_across")
    return methods[methods["hurst"].notna() & (methods["elements"] == across)]
