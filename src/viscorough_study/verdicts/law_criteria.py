"""Judge claims that fitted exponents and curves follow a law of the paper.

The paper leaves some choices open, such as the kind of mean and the range of X of a fit. They are called conventions
here. A claim may hold in some conventions and fail in others. The verdict then states both facts and names the
convention in which the claim holds, also if the figures use a different convention.
"""

import numpy as np

from viscorough import reference
from viscorough_study.fits.conventions import FITTED, select, source_values
from viscorough_study.fits.intervals import UNDEFINED, deviation_interval, difference, interval, with_interval
from viscorough_study.fits.power_law import fit_power_law, in_window, log_means
from viscorough_study.verdicts.evidence import Law, hurst_name, judged
from viscorough_study.verdicts.region_criteria import combinations_case

# A disc with n elements across has more than this share of the n² elements of the square around it.
SHARE_OF_SQUARE = 0.75


# ---- claims about fitted exponents


def beta(evidence, tolerance, source="discs"):
    """Test whether the exponent β is H/(1 + H), at the Hurst exponents for which the paper claims this.

    source : "discs" or "lines"
    """
    fits, every = evidence.fits(source), evidence.every_fit(source)
    fits = fits[fits.index > evidence.paper_value("agreement", "beta_hurst_min")]
    named = {"names": list(FITTED), "compared": every["case_group"] == "base"}
    return evidence.cases_in_conventions(fits, every, "beta", Law(reference.exponent_beta, tolerance), **named)


def beta_lines(evidence, tolerance):
    """Test whether the exponent β of lines is H/(1 + H), at the Hurst exponents for which the paper claims this."""
    return beta(evidence, tolerance, "lines")


def exponent_small_hurst(evidence, tolerance):
    """Test whether the exponent β is H/(1 + H) also at the small Hurst exponents about which the paper claims nothing.

    The claim is tested for each of these Hurst exponents, for discs and for lines. The tested value is β − H/(1 + H).
    """
    disc_fits = evidence.fits("discs")
    small = disc_fits.index[disc_fits.index <= evidence.paper_value("agreement", "beta_hurst_min")]
    for source in ("discs", "lines"):
        fits = evidence.fits(source)
        for hurst in small.intersection(fits.index):
            row = fits.loc[hurst]
            values = np.array(interval(row, "beta")) - reference.exponent_beta(hurst)
            context = {"realizations": row["realizations"], "cases": 2 * len(small)}
            name = f"{hurst_name(hurst)}, {source}"
            yield evidence.case(name, tuple(values), 0.0, (-tolerance, tolerance), **context)


def exponent_limit(evidence, tolerance):
    """Test whether the exponent β tends to H/(1 + H) on fine grids and at small X (fits.fine_grids).

    The claim is tested for each Hurst exponent, in the decade of the smallest X that the finest grids support, by the
    published table. The tested value is the limit of β, or β on the finest grid if the limit is open.
    """
    table = evidence.tables.get("fine_exponents")
    if table is None or table.empty:
        yield judged("all H", UNDEFINED, np.nan, None)
        return
    for row in table.query("judged == 1 and quantity == 'whole'").to_dict("records"):
        values = interval(row, "beta" if row["finding"] == "open" else "limit")
        name = f"{hurst_name(row['hurst'])}, X from {row['x_low']:.2g} to {10 * row['x_low']:.2g}"
        yield judged(name, values, row["expected"], {"within": True, "outside": False}.get(row["finding"]))


def coincide(evidence, tolerance):
    """Test whether the exponents β of MDR lines and of discs are equal at equal Hurst exponents.

    The claim is tested for each Hurst exponent. The tested value is β of the lines minus β of the discs. It is computed
    with every kind of mean, window of the fit, and definition of the rms height, which the paper leaves open.
    """
    discs, lines = (evidence.every_fit(source).query("case_group == 'base'") for source in ("discs", "lines"))
    both = discs.merge(lines, on=["hurst", "average", "window_rule"], how="left", suffixes=("", "_of_lines"))
    line_columns = tuple(both[f"{name}_of_lines"] for name in ("beta", "beta_low", "beta_high"))
    columns = ["difference", "difference_low", "difference_high"]
    both = both.assign(**dict(zip(columns, difference(interval(both, "beta"), line_columns), strict=True)))
    both["realizations"] = both[["realizations", "realizations_of_lines"]].min(axis=1)
    own = select(both, evidence.conventions).set_index("hurst")
    return evidence.cases_in_conventions(own, both, "difference", Law(lambda h: 0.0 * h, tolerance), names=list(FITTED))


def hurst_only(evidence, tolerance):
    """Test whether the exponent β depends on H alone, and not on force, viscosity, L and h.

    The value is the standard deviation of β between combinations of these four quantities at equal H, without the
    sampling scatter of β.
    """
    if None in evidence.regions.values():
        yield judged("all H", UNDEFINED, 0.0, None)
        return
    windows, combinations = evidence.regions, evidence.combinations.items()
    slopes = [[_slopes(ensemble, windows[hurst]) for ensemble in ensembles] for hurst, ensembles in combinations]
    yield combinations_case(evidence, slopes, 0.0, tolerance)


def no_grid(evidence, tolerance):
    """Test whether the stiffness κ at a given depth u/h is independent of the grid.

    The claim is tested for each Hurst exponent and each depth. The tested value is the factor by which κ changes if the
    number of elements grows tenfold (fits.grid_dependence). The least and the largest κ of the grids are stated as
    well. The interval of the factor already includes the effect of the number of realizations, so this number does not
    influence the verdict a second time.
    """
    table, ends = evidence.tables["grid_dependence"], (1 / (1 + tolerance), 1 + tolerance)
    table = table[table["quantity"].str.startswith("κ at u/h") & (table["compared"] == 1)].dropna(subset="factor")
    if table.empty:
        yield judged("all H", UNDEFINED, 1.0, None)
    groups = table.groupby(["hurst", "quantity"])
    for (hurst, quantity), grids in groups:
        context = {"cases": len(groups), "extremes": (grids["value"].min(), grids["value"].max())}
        values, name = interval(grids.iloc[0], "factor"), f"{hurst_name(hurst)}, {quantity}"
        yield evidence.case(name, values, 1.0, ends, realizations=np.inf, **context)


def realizations(evidence, tolerance):
    """Test whether the paper has enough indentations in Fig. 4 to determine the exponent β.

    The claim is tested for each Hurst exponent. The tested value is half the width of the 95 % interval of β for this
    number of indentations. This half width has a 95 % interval itself, by the χ² distribution of the standard deviation
    of normal samples.
    """
    number = evidence.paper_value("boundary_elements", "realizations_fig4")

    def half_width(_, ensemble, window):
        slopes = _slopes(ensemble, window)
        return deviation_interval(1.96 * slopes.std(ddof=1) / np.sqrt(number), slopes.size - 1), slopes.size

    return _cases_in_regions(evidence, half_width, np.nan, (-np.inf, tolerance))


def _cases_in_regions(evidence, evaluate, expected, allowed):
    """Test a quantity in region (b), where the curves follow a power law; yield a verdict for each Hurst exponent.

    evaluate : function of H, the ensemble and the ends (X_low, X_high) of region (b); returns the quantity as (value,
        low, high), and the number of realizations
    expected : value of the paper, or nan
    allowed : range (low, high) in which the claim allows the quantity
    The ensembles are taken from `Evidence.pooled`. If an ensemble has no region (b), the verdict is "undecided".
    """
    for hurst, ensemble in evidence.pooled.items():
        window = evidence.regions[hurst]
        values, number = (UNDEFINED, 0) if window is None else evaluate(hurst, ensemble, window)
        counts = {"realizations": number, "cases": len(evidence.pooled)}
        yield evidence.case(hurst_name(hurst), values, expected, allowed, **counts)


def _slopes(ensemble, window):
    """Return the slope of ln(vt/h) along ln X in a window of X, for every realization of the ensemble.

    Realizations that are undefined in a part of the window are omitted.
    """
    inside = in_window(ensemble["x"].values, window)
    log_x, log_velocity = np.log(ensemble["x"].values[inside]), np.log(ensemble["velocity"].values[:, inside])
    log_velocity = log_velocity[np.isfinite(log_velocity).all(axis=1)]
    return np.polyfit(log_x, log_velocity.T, 1)[0]


def alpha_limit(evidence, tolerance):
    """Test whether the exponent β is 1/2 at H = 1, where the paper calls the exponent exact.

    The claim is tested for MDR lines, and for discs on the paper's grid.
    """
    chosen = evidence.conventions | source_values("discs") | {"case_group": "sizes"}
    discs = select(evidence.tables["sizes"], chosen).set_index("hurst")
    discs = discs[discs["elements"] >= SHARE_OF_SQUARE * evidence.across**2].sort_values("elements", kind="stable")
    for source, fits in (("lines", evidence.fits("lines")), ("discs", discs)):
        fit = fits[fits.index == 1.0].head(1).to_dict("records")
        values, number = (interval(fit[0], "beta"), fit[0]["realizations"]) if fit else (UNDEFINED, 0)
        ends = 0.5 - tolerance, 0.5 + tolerance
        yield evidence.case(f"H = 1, {source}", values, 0.5, ends, realizations=number, cases=2)


# ---- claims about the depth u/h and the velocity vt/h as functions of X


def depth(evidence, tolerance):
    """Test whether (1 − α)κu/(hX) is 1 at the centre of region (b), as it is if the stiffness κ is a power law κ ∝ X^α.

    The depth is u/h = ∫dX/κ, where κ is constant below the first abscissa.
    """

    def ratio(hurst, ensemble, betas, zetas, centre):
        x, softness = ensemble["x"].values, 1 / ensemble["stiffness"].values
        end = int(np.argmin(np.abs(np.log(x / centre)))) + 1
        depths = x[0] * softness[:, 0] + np.trapezoid(softness[:, :end], x[:end], axis=1)
        ratios = (depths / (x[end - 1] * softness[:, end - 1]))[:, None]
        # With the seed of the fit, the same realizations are drawn as for `betas`. The interval of the product
        # therefore includes the scatter of both factors.
        random = np.random.default_rng(evidence.seed)
        return betas * np.exp(log_means(ratios, "arithmetic", evidence.resamples, random))[:, 0]

    return _cases_at_centre(evidence, tolerance, ratio)


def master_curve(evidence, tolerance):
    """Test whether vt/h follows Eq. 12 as printed, in region (b).

    The claim is tested for each Hurst exponent of the discs, for the discs and for MDR lines. The tested value is the
    root mean square of ln(vt/h) less the right side of Eq. 12 over region (b). It has two parts, which add in
    quadrature: the logarithm of the ratio of prefactors, in a fit with β = H/(1 + H) and in Eq. 12, and the residual of
    this fit. The interval is from the first part.
    """
    discs, lines = (evidence.fits(source, gamma="with") for source in ("discs", "lines"))
    lines = lines[lines.index.isin(list(evidence.pooled))]
    for source, fits in (("", discs), (", lines", lines)):
        for hurst, row in fits.iterrows():
            value, *ends = np.log(interval(row, "zeta_fixed")) - np.log(reference.zeta_viscous(hurst))
            nearest = 0.0 if ends[0] < 0 < ends[1] else np.min(np.abs(ends))
            values = np.hypot([value, nearest, np.max(np.abs(ends))], row["residual_fixed"])
            context = {"realizations": row["realizations"], "cases": len(discs) + len(lines)}
            yield evidence.case(f"{hurst_name(hurst)}{source}", tuple(values), 0.0, (-np.inf, tolerance), **context)


def _cases_at_centre(evidence, tolerance, ratio):
    """Test whether a ratio at the geometric centre of region (b) is 1; yield a verdict for each Hurst exponent.

    If an ensemble has no region (b), the verdict is "undecided".
    ratio : function of H, ensemble, β, ζ, and X at the centre. β and ζ are arrays with the value of the fit and the
        values of bootstrap resamples. The function returns the ratio as an array of the same form.
    """
    bootstrap = {"average": evidence.conventions["average"], "resamples": evidence.resamples, "seed": evidence.seed}

    def evaluate(hurst, ensemble, window):
        fit = fit_power_law(ensemble["x"].values, ensemble["velocity"].values, window, **bootstrap)
        number = ensemble.sizes["realization"]
        return with_interval(ratio(hurst, ensemble, *fit, np.sqrt(np.prod(window))), number), number

    return _cases_in_regions(evidence, evaluate, 1.0, (1 - tolerance, 1 + tolerance))
