"""Judge claims that fitted exponents and curves follow a law of the paper.

A claim may hold in some of the conventions that the paper leaves open, and fail in others. The verdict then states both
facts and names the convention in which the claim holds, also if the figures use a different convention.
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


# ---- exponents


def beta(evidence, tolerance, source="discs"):
    """Compare β with H/(1 + H), for the Hurst exponents that this claim of the paper covers."""
    fits, every = evidence.fits(source), evidence.every_fit(source)
    fits = fits[fits.index > evidence.paper_value("agreement", "beta_hurst_min")]
    named = {"names": list(FITTED), "compared": every["case_group"] == "base"}
    return evidence.cases_in_conventions(fits, every, "beta", Law(reference.exponent_beta, tolerance), **named)


def beta_lines(evidence, tolerance):
    """Compare β of lines with H/(1 + H)."""
    return beta(evidence, tolerance, "lines")


def exponent_small_hurst(evidence, tolerance):
    """Yield β − H/(1 + H) of discs and lines, for the Hurst exponents about which the paper claims nothing."""
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


def coincide(evidence, tolerance):
    """Compare β of lines with β of discs at equal Hurst exponents, by their difference, in all conventions."""
    discs, lines = (evidence.every_fit(source).query("case_group == 'base'") for source in ("discs", "lines"))
    both = discs.merge(lines, on=["hurst", "average", "window_rule"], how="left", suffixes=("", "_of_lines"))
    line_columns = tuple(both[f"{name}_of_lines"] for name in ("beta", "beta_low", "beta_high"))
    columns = ["difference", "difference_low", "difference_high"]
    both = both.assign(**dict(zip(columns, difference(interval(both, "beta"), line_columns), strict=True)))
    both["realizations"] = both[["realizations", "realizations_of_lines"]].min(axis=1)
    own = select(both, evidence.conventions).set_index("hurst")
    return evidence.cases_in_conventions(own, both, "difference", Law(lambda h: 0.0 * h, tolerance), names=list(FITTED))


def hurst_only(evidence, tolerance):
    """Yield the standard deviation of β between combinations of force, viscosity, L and h, without sampling scatter."""
    if None in evidence.regions.values():
        yield judged("all H", UNDEFINED, 0.0, None)
        return
    windows, combinations = evidence.regions, evidence.combinations.items()
    slopes = [[_slopes(ensemble, windows[hurst]) for ensemble in ensembles] for hurst, ensembles in combinations]
    yield combinations_case(evidence, slopes, 0.0, tolerance)


def no_grid(evidence, tolerance):
    """Yield the ratio of κ at given u/h with ten times as many elements to κ without (fits.grid_dependence).

    The extremes of a case are the least and the largest κ of the grids. The number of realizations of a grid is already
    in the interval of the factor, and does not enter the verdict a second time.
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
    """Return the cases of half the width of the 95 % interval of β for as many indentations as in the paper's Fig. 4.

    This half width has an interval itself, by the χ² distribution of the standard deviation of normal samples.
    """
    number = evidence.paper_value("boundary_elements", "realizations_fig4")

    def half_width(_, ensemble, window):
        slopes = _slopes(ensemble, window)
        return deviation_interval(1.96 * slopes.std(ddof=1) / np.sqrt(number), slopes.size - 1), slopes.size

    return _cases_in_regions(evidence, half_width, np.nan, (-np.inf, tolerance))


def _cases_in_regions(evidence, evaluate, expected, allowed):
    """Yield the cases of a quantity in region (b) of the ensembles in `Evidence.pooled`, one for each H.

    evaluate : function of H, ensemble and window; returns (value, low, high) and the number of realizations
    expected : value of the paper, or nan; allowed : (low, high)
    A case without a region is undecided.
    """
    for hurst, ensemble in evidence.pooled.items():
        window = evidence.regions[hurst]
        values, number = (UNDEFINED, 0) if window is None else evaluate(hurst, ensemble, window)
        counts = {"realizations": number, "cases": len(evidence.pooled)}
        yield evidence.case(hurst_name(hurst), values, expected, allowed, **counts)


def _slopes(ensemble, window):
    """Return the slope of ln(vt/h) along ln X in a window, for every realization defined in the whole window."""
    inside = in_window(ensemble["x"].values, window)
    log_x, log_velocity = np.log(ensemble["x"].values[inside]), np.log(ensemble["velocity"].values[:, inside])
    log_velocity = log_velocity[np.isfinite(log_velocity).all(axis=1)]
    return np.polyfit(log_x, log_velocity.T, 1)[0]


def alpha_limit(evidence, tolerance):
    """Yield β of lines, and of discs on the paper's grid, at H = 1, where the paper calls the exponent exact."""
    chosen = evidence.conventions | source_values("discs") | {"case_group": "sizes"}
    discs = select(evidence.tables["sizes"], chosen).set_index("hurst")
    discs = discs[discs["elements"] >= SHARE_OF_SQUARE * evidence.across**2].sort_values("elements", kind="stable")
    for source, fits in (("lines", evidence.fits("lines")), ("discs", discs)):
        fit = fits[fits.index == 1.0].head(1).to_dict("records")
        values, number = (interval(fit[0], "beta"), fit[0]["realizations"]) if fit else (UNDEFINED, 0)
        ends = 0.5 - tolerance, 0.5 + tolerance
        yield evidence.case(f"H = 1, {source}", values, 0.5, ends, realizations=number, cases=2)


# ---- curves


def depth(evidence, tolerance):
    """Return the cases of (1 − α)κu/(hX) at the centre of region (b), which is 1 for a power law of κ.

    The depth is u/h = ∫dX/κ, where κ is constant below the first abscissa.
    """

    def ratio(hurst, ensemble, betas, zetas, centre):
        x, softness = ensemble["x"].values, 1 / ensemble["stiffness"].values
        end = int(np.argmin(np.abs(np.log(x / centre)))) + 1
        depths = x[0] * softness[:, 0] + np.trapezoid(softness[:, :end], x[:end], axis=1)
        ratios = (depths / (x[end - 1] * softness[:, end - 1]))[:, None]
        # With the seed of the fit the same realizations are drawn, so the interval includes the scatter of both
        # factors.
        random = np.random.default_rng(evidence.seed)
        return betas * np.exp(log_means(ratios, "arithmetic", evidence.resamples, random))[:, 0]

    return _cases_at_centre(evidence, tolerance, ratio)


def master_curve(evidence, tolerance):
    """Yield the ratio of vt/h to the right side of Eq. 12 as printed, at the centre of region (b).

    There are cases for discs, and for lines at the Hurst exponents of the discs.
    """

    def ratio(hurst, ensemble, betas, zetas, centre):
        return centre**betas / zetas / reference.rate_law(centre, hurst, gamma=True)

    discs = list(_cases_at_centre(evidence, tolerance, ratio))
    yield from discs
    lines = evidence.fits("lines")
    lines = lines[lines.index.isin(list(evidence.pooled))]
    for hurst, row in lines.iterrows():
        centre = np.sqrt(row["x_low"] * row["x_high"])
        value = ratio(hurst, None, row["beta"], row["zeta"], centre)
        # The relative error of ζ is the error of vt/h at X = 1. It is an upper bound of the error at the centre of the
        # fit.
        zeta, zeta_low, zeta_high = interval(row, "zeta")
        values = value, value * zeta / zeta_high, value * zeta / zeta_low
        context = {"realizations": row["realizations"], "cases": len(discs) + len(lines)}
        yield evidence.case(f"{hurst_name(hurst)}, lines", values, 1.0, (1 - tolerance, 1 + tolerance), **context)


def _cases_at_centre(evidence, tolerance, ratio):
    """Return the cases of a ratio that should be 1 at the geometric centre of region (b); undecided without a region.

    ratio : function of H, ensemble, β and ζ (arrays of fit and resamples), and centre X; returns the ratio and its
        resamples
    """
    bootstrap = {"average": evidence.conventions["average"], "resamples": evidence.resamples, "seed": evidence.seed}

    def evaluate(hurst, ensemble, window):
        fit = fit_power_law(ensemble["x"].values, ensemble["velocity"].values, window, **bootstrap)
        number = ensemble.sizes["realization"]
        return with_interval(ratio(hurst, ensemble, *fit, np.sqrt(np.prod(window))), number), number

    return _cases_in_regions(evidence, evaluate, 1.0, (1 - tolerance, 1 + tolerance))
