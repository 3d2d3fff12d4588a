"""Judge claims on the methods of the paper.

The claims concern the equivalence of the viscous and the elastic problem, the factor 1/Γ(2 − α), the method of
dimensionality reduction (MDR) with its line spectrum, and the numbers of elements and of contact problems.
"""

import numpy as np

from viscorough.surfaces.self_affine import cut_disc
from viscorough_study.fits.intervals import UNDEFINED, difference
from viscorough_study.verdicts.evidence import exact, judged

SMALL_ERROR = 0.01  # explicit integrations with a larger relative error of the velocity do not count
HUNDREDS = 100  # smallest number of contact problems that counts as "some hundreds"
# Name of a method in the table of methods. This method solves a contact problem in every time step.
EXPLICIT = "explicit, logarithmic steps"


def equivalence(evidence, tolerance):
    """Test whether the viscous depth, by direct integration in time, is the elastic depth under the force GFt/η.

    The claim is tested for each indenter. The tested value is the median of the ratio of viscous to elastic depth.
    """
    return _depth_ratios(evidence, tolerance, lambda rows: 1.0)


def gamma(evidence, tolerance):
    """Test whether the viscous depth, by direct integration in time, is the elastic depth times the factor in Eq. 8.

    The claim is tested for each indenter. The tested value is the median of the ratio of viscous to elastic depth.
    """
    return _depth_ratios(evidence, tolerance, lambda rows: rows["with_gamma"].iloc[0])


def _depth_ratios(evidence, tolerance, expected):
    """Test whether all ratios of viscous to elastic depth have an expected value; yield a verdict for each indenter.

    expected : function of the rows of an indenter in the table of direct integration
    """
    for name, rows in evidence.tables["direct"].groupby("case", sort=False):
        ratio, factor = rows["depth_ratio"], expected(rows)
        yield exact(name, ratio.median(), factor, (np.abs(ratio - factor) <= tolerance).all(), ratio)


def line_spectrum(evidence, tolerance):
    """Test whether the factor λ in the spectrum of a line (Eq. 13) depends on the Hurst exponent H.

    The tested value is the ratio of λ at the largest H to λ at the smallest. If the ratio differs from 1 by more than
    the tolerance, λ is not constant, and so not π. The two λ are independent, so the half-widths of the intervals of
    their logarithms add in quadrature. The smallest and the largest λ/π of all Hurst exponents are stated as well.
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
    """Test whether the method of dimensionality reduction is exact for bodies of revolution.

    The claim is tested for each body and each quantity, such as the force. The tested value is the error of the method
    on the finest grid. The least and the largest error of all grids are stated as well.
    """
    validation = evidence.tables["validation"]
    rows = validation[validation["case"].str.endswith("_reduction")]
    for (case, quantity), grids in rows.groupby(["case", "quantity"], sort=False):
        error = grids.sort_values("elements")["error"]
        name = f"{case.removesuffix('_reduction')}, {quantity}"
        yield exact(name, error.iloc[-1], 0.0, error.iloc[-1] <= tolerance, error)


def elements(evidence, tolerance):
    """Test whether a disc with the paper's number of elements across has as many elements in total as the paper states.

    The total numbers without and with the elements whose centres lie exactly on the rim are stated as well.
    """
    across, paper_count = (evidence.paper_value("boundary_elements", name) for name in ("elements_across", "elements"))
    count = np.isfinite(cut_disc(np.zeros((across, across)), across)).sum()
    x = np.arange(across) - (across - 1) / 2
    on_rim = (x[:, None] ** 2 + x**2 == ((across - 1) / 2) ** 2).sum()
    met = abs(count - paper_count) <= tolerance
    yield exact(f"{across} across", count, paper_count, met, (count - on_rim, count))


def contact_problems(evidence, tolerance):
    """Test whether the indentation of one disc takes some hundreds of contact problems, which are counted in two ways.

    1. A new contact problem is needed whenever an element comes into contact. So the number of contact problems is the
       largest number of elements in contact.
    2. Explicit integration in time solves a contact problem in every step. So the number of contact problems is the
       number of steps. For each rough disc, this is the smallest number with which the relative error of the velocity
       is at most `SMALL_ERROR`. A disc is omitted if all integrations have larger errors.

    Yields a verdict for each way. The tested value is the median of the numbers for all discs. The smallest and the
    largest of these numbers are stated as well.
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
