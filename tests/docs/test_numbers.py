"""The numbers on the pages of README and docs/ agree with the published tables."""

import json
import re
from functools import cache

import numpy as np
import pandas as pd
import publish
import pytest
from measuring import fit_cost

from support.documentation import ROOT, read
from support.study import CLAIMS
from support.workflow import merged, read_settings
from viscorough.contact.preconditioner import LEAST_EIGENVALUE
from viscorough.contact.step_control import _RELAXED_BOUND
from viscorough.law.calibrated_law import penetration_law
from viscorough.reference import exponent_beta
from viscorough_study.run.cases import disc_cases

TABLE = publish.published_claims()
LAW = pd.read_csv(ROOT / "src/viscorough/law/data/law.csv").query("across == 257").set_index("hurst")
BENCHMARKS = json.loads(read(ROOT / "docs/results/benchmarks.json"))
OTHER_TIMES = pd.read_csv(ROOT / publish.OTHER_SOLVERS)["ratio"]
DISCS = "source == 'discs' and average == 'geometric' and rms_convention == 'disc'"


@cache
def words(page):
    return " ".join(read(ROOT / page).split())


@cache
def published(name):
    """Return a table of docs/results."""
    return pd.read_csv(ROOT / "docs/results" / name)


def value(claim, case=slice(None), column="value"):
    """Return the values of a claim by case, or the value of one case."""
    return TABLE[TABLE["claim"] == claim].set_index("case")[column].loc[case]


def ends(values, places=0):
    """Return the smallest and the largest of some values, rounded."""
    return [f"{end:.{places}f}" for end in (np.min(values), np.max(values))]


def percents(claim):
    """Return how far the smallest and the largest value of a claim are from the paper's number [%]."""
    ratios = value(claim) / value(claim, column="expected")
    return ends(100 * abs(ratios - 1))


def base_fits():
    """Return the fits of discs in the conventions of the figures, by Hurst exponent."""
    rows = published("scaling.csv").query(f"{DISCS} and case_group == 'base' and window_rule == 'default'")
    return rows.set_index("hurst")


def contact_at(rule):
    """Return the shares of elements in contact where region (c) begins by a rule for the slope [%]."""
    shares = 100 * value("complete_contact")
    return shares[shares.index.str.contains(rule)]


@cache
def grid_errors():
    """Errors of the velocity on 257 elements across, by every second point of 513, at H = 0.4 and 0.8 [%]."""
    rows = published("one_surface.csv").query("quantity == 'velocity' and model == 'grid' and across == 257")
    return 100 * rows.query("value == 1e-3").set_index("hurst")["error"][[0.4, 0.8]]


def above_expected():
    """Return β − H/(1 + H) of discs at H = 0.4 and 0.1."""
    beta = base_fits()["beta"][[0.4, 0.1]]
    return beta - beta.index.map(exponent_beta)


def equal_windows():
    """Return how far exponents of lines and discs differ in equal windows: largest for H ≥ 0.6, at 0.4, at 0.1."""
    distance = published("mdr_exponents.csv").query("window != 'own region'").set_index("hurst")["difference"].abs()
    return distance[[0.6, 0.9]].max(), distance[0.4].max(), distance[0.1].max()


def grid_factors(quantity):
    """Return the factors of a quantity on a grid of ten times as many elements, by Hurst exponent."""
    return published("grid_dependence.csv").query("quantity == @quantity").groupby("hurst")["factor"].max().to_numpy()


def trends(window_rule):
    """Return the change of β with ten times as many elements, by source and Hurst exponent, in a fixed window of X.

    The slopes are least-squares fits, weighted by the intervals.
    """
    table = published("sizes.csv").query(f"case_group == 'sizes' and window_rule == '{window_rule}'")
    table = table.query("average == 'geometric' and rms_convention in ('disc', 'line')").dropna(subset="beta")
    weight = 1 / (table["beta_high"] - table["beta_low"])
    slopes = {
        key: np.polyfit(np.log10(rows["elements"]), rows["beta"], 1, w=weight[rows.index])[0]
        for key, rows in table.groupby(["source", "hurst"])
        if len(rows) > 2
    }
    return pd.Series(slopes)


def default_path():
    """Return the rows of boundary elements at the default tolerance, on rough discs of 257 elements across."""
    methods = published("methods.csv").dropna(subset="hurst")
    return methods.query("method == 'path, automatic levels' and value == 1e-3 and elements == 257")


def periodic(roll_off):
    """Return the smallest and the largest g of periodic surfaces around X = 1, with or without a roll-off."""
    table = published("periodic.csv").query("0.7 < x < 1.4")
    return ends(table[table["roll_off_wavelength"].notna() == roll_off].groupby("hurst")["g"].mean(), 2)


def largest(roll_off):
    """Return the largest g of periodic surfaces by Hurst exponent, then its X, with or without a roll-off."""
    table = published("periodic.csv")
    rows = table[table["roll_off_wavelength"].notna() == roll_off]
    highest = rows.loc[rows.groupby("hurst")["g"].idxmax()]
    return [*highest["g"], *highest["x"]]


def plateau():
    """Return u₀/h of discs on the paper's grid."""
    rows = published("interface.csv").query("source == 'discs' and across == 257")
    return rows.drop_duplicates("hurst")


def large(across):
    return published("large.csv").set_index("across").loc[across]


def growth_of_large(across):
    return fit_cost(large(across)["elements"], large(across)["wall"])[0]


def placed(choice, *scenes):
    """Times of automatic levels over those of levels placed otherwise for the same accuracy, in these scenes."""
    table = published("level_placement.csv").query("scene in @scenes")
    times = table.pivot(index=["scene", "accuracy"], columns="choice", values="processor_s")
    return times["automatic"] / times[choice]


def errors_of_means(*models):
    """Errors of models of the mean velocity over all Hurst exponents, with as many surfaces as there are [%]."""
    table = published("mean_accuracy.csv").query("quantity == 'velocity' and model in @models")
    return 100 * table.loc[table.groupby(["model", "hurst"])["surfaces"].idxmax(), "error"]


def costs(column="seconds"):
    return published("rule_costs.csv").set_index("rule")[column]


def minutes_of_paper():
    return costs("share_s").sum() / 60


PAPER, DEFAULT = merged(read_settings("config"), read_settings("paper")), read_settings("config")


def discs_of_paper(settings=PAPER):
    """Return the numbers of discs of a scale, by default the paper's: for the figures, and for everything else."""
    cases = disc_cases(settings).values()
    discs = [(case["group"] == "base", ensemble["realizations"]) for case in cases for ensemble in case["ensembles"]]
    return pd.DataFrame(discs).groupby(0)[1].sum().sort_index(ascending=False)


def milliseconds(settings):
    """Return the processor time of a line and of a disc in the published run with these settings [ms]."""
    seconds = costs() if settings is PAPER else pd.read_csv(ROOT / publish.DEFAULT_COSTS).set_index("rule")["seconds"]
    lines = len(settings["lines"]["hurst"]) * settings["lines"]["realizations"]
    return 1e3 * seconds["reduce_lines"] / lines, 1e3 * seconds["indent_surfaces"] / discs_of_paper(settings).sum()


def reduction_costs():
    """Return the cost of a line over the cost of a disc in the default run and at the paper's scale [%]."""
    return [100 * np.divide(*milliseconds(settings)) for settings in (DEFAULT, PAPER)]


def single_surfaces(x):
    """Return the ends of the interval of vt/h of a single surface over the law, at H = 0.1 and 0.85."""
    laws = [penetration_law(hurst) for hurst in (0.1, 0.85)]
    return [end for law in laws for end in law.velocity_interval(x) / law.velocity(x)]


def law_errors(*names):
    """Return the largest errors of the law over the mean of fresh discs of 257 elements across, rounded up [%]."""
    table = publish.largest_errors().query("across == 257")
    return [np.ceil(100 * table[name].abs().max()) for name in names]


def depth_error_on_coarse_grid():
    """Return the errors of u/h of the law on 129 elements across at X = 0.003, at H = 0.85 and 0.1 [%]."""
    table = published("law_errors.csv").query("across == 129 and 0.003 < x < 0.004").set_index("hurst")
    return 100 * table["depth_error"][[0.85, 0.1]]


# {page: {sentence: function that returns the text or the numbers for its brackets}}
QUOTED = {
    "README.md": {
        "surfaces, in {:.0f} minutes": minutes_of_paper,
    },
    "docs/verification.md": {
        "factors of {:.2f}, {:.2f}, {:.2f} and {:.2f}": lambda: value("lambda_constant"),
        "of {:.0f}, {:.0f}, {:.0f} and {:.0f} %, and": lambda: 100 * value("exact_correspondence").abs(),
        "up to {:.0f}, {:.0f}, {:.0f} and {:.0f} % |": lambda: 100 * value("whole_curve").abs(),
        "within {:.2f} at *H* = 0.6 and 0.9; {:.2f} below at *H* = 0.4 (undecided), {:.2f} below at": equal_windows,
        "{} to {} times too large": lambda: ends(value("line_area")),
        "{} to {} of that of the discs": lambda: ends(value("line_gap"), 2),
        "{:.0f} % of the cost by boundary elements in `make paper`": lambda: reduction_costs()[1],
        "{:.0f} ms for a line of 4 000 000 points, {:.0f} ms for a disc": lambda: milliseconds(PAPER),
        "In the default run {:.0f} %": lambda: reduction_costs()[0],
        "{:.1f} ms for a line of 131 072 points, {:.0f} ms for a disc": lambda: milliseconds(DEFAULT),
        "a factor of {:.1f} to": lambda: value("single_surface", column="least").min(),
        "to {:.1f} in region (b)": lambda: value("single_surface", column="largest").max(),
        "above *H*/(1 + *H*), by {1:.2f} and {0:.2f}": above_expected,
        "between {:.2f} and {:.2f} times the law at *H* = 0.1, and between {:.2f} and {:.2f} times": lambda: (
            single_surfaces(0.01)
        ),
        "At *X* = 1 these are {:.2f} and {:.2f}, and {:.2f} and {:.2f} times": lambda: single_surfaces(1.0),
        "by {:.2f} and {:.2f}": lambda: value("coincide").abs()[["H = 0.1", "H = 0.4"]],
        "elements change it by at most {:.3f}, at any": lambda: trends("X = 0.01 to 0.1").abs().max(),
        "which would be {} to {}": lambda: ends(value("gamma", column="expected"), 2),
        "by {:.2f}, {:.2f} and {:.2f} at *H* = 0.1, 0.4 and 0.6, and leave": lambda: grid_factors("κ at u/h = 1")[:3],
        "by {:.0f}, {:.0f}, {:.0f} and {:.0f} % at *H*": lambda: 100 * (grid_factors("u/h at X = 0.1")[:4] - 1),
    },
    "src/viscorough/cli/estimate.py": {
        "agreed with the law within {:.0f} % for vt/h and {:.0f} % for g": lambda: law_errors("velocity", "interface"),
    },
    "src/viscorough/law/calibrated_law.py": {
        "law by at most {:.0f} % in vt/h, {:.0f} % in g, and {:.0f} % in u/h": lambda: law_errors(
            "velocity", "interface", "depth"
        ),
        "129 elements across by {:.0f} % at H = 0.85 and by {:.0f} % at H = 0.1": depth_error_on_coarse_grid,
    },
    "docs/theory.md": {
        "it is {} to {} at *H* = 0.1, 0.6 and 0.9": lambda: periodic(roll_off=False),
        "values are {:.3f}, {:.3f} and {:.3f}, at *X* = {:.1f}, {:.1f} and {:.1f}": lambda: largest(roll_off=False),
        "the same, {:.3f}, {:.3f} and {:.3f}, but lie at larger *X*, {:.1f}, {:.1f} and": lambda: largest(
            roll_off=True
        ),
        "would be {:.2f}, {:.2f} and {:.2f} times Eq. 11": lambda: publish.prefactors()["if_radius"][[0.4, 0.6, 0.9]],
        "*α* is {:.2f} at *H* = 0.1.": lambda: 1 - base_fits()["beta"][0.1],
        "end earlier. There {:.0f}, {:.0f}, {:.0f} and {:.0f} % of": lambda: 100 * value("complete_contact_end"),
        "Up to {} times the bound": lambda: str(_RELAXED_BOUND),
    },
    "docs/verdicts.md": {
        "is 1 within 0.05, {:.0f}, {:.0f}, {:.0f} and {:.0f} % of": lambda: contact_at("within 0.05"),
        "is 1 within 0.01, {:.0f}, {:.0f} and {:.0f} % touch": lambda: contact_at("within 0.01").dropna(),
        "end of the curves {:.0f}, {:.0f}, {:.0f} and {:.0f} % touch": lambda: 100 * value("complete_contact_end"),
        "a factor of {} on *vt*/*h* or of {} on *X*, with": lambda: [
            case.split()[-1] for case in value("one_constant").index
        ],
        "a root mean square of {:.0f} or {:.0f} % (": lambda: 100 * value("one_constant"),
    },
    "docs/scaling.md": {
        "| {:.0f} s | `make large`": lambda: large(4097)["wall"],
        "| {:.1f} GB |": lambda: large(4097)["memory"] / 1e9,
        "elements to the power {:.1f}, to which": lambda: growth_of_large([257, 4097]),
    },
    "docs/questions.md": {
        "4097 elements across takes {:.0f} s": lambda: large(4097)["wall"],
        "takes {:.2f} to {:.2f} s for a disc of 257": lambda: default_path()["wall_s"].agg(["min", "max"]),
    },
    "docs/reproduce.md": {
        "at most {:.2f} GB per job": lambda: pd.read_csv(ROOT / publish.DEFAULT_COSTS)["memory_mb"].max() / 1000,
        "50 500 lines: {:.0f} minutes": minutes_of_paper,
        "which shows them; {} (": publish.default_minutes,
        "{} discs for the figures, {} for variants and grids": discs_of_paper,
    },
    "docs/performance.md": {
        "velocity by {:.0f} % at *H* = 0.4 and {:.0f} % at": grid_errors,
        "takes {:.0f} s, and the contact at one force {:.1f} s": lambda: [
            BENCHMARKS["large_map"][question]["wall_s"] for question in ("curve", "contact")
        ],
        "takes {} to {} times as long as its applications": lambda: ends(
            [steps["whole"] for steps in BENCHMARKS["over_operator"].values()], 1
        ),
        "to the power {:.2f} from 129 to 4097": lambda: growth_of_large(slice(129, 4097)),
        "(power {:.2f}; `make large`)": lambda: growth_of_large(slice(4097, 8193)),
        "up to {:.1f} times the time of the best levels by hand there": lambda: placed(
            "best by hand", "region (b)", "full curve"
        ).max(),
        "and up to {:.1f} times on a smooth asperity": lambda: placed("best by hand", "one asperity").max(),
        "naive levels take at least {:.1f} times as long": lambda: (1 / placed("naive", "full curve")).min(),
        "It is off by {:.1f} to {:.0f} %": lambda: errors_of_means("law").agg(["min", "max"]),
        "the mean of the MDR stays off by {:.0f} to {:.0f} %": lambda: errors_of_means(
            "MDR, λ = π", "MDR, λ fitted"
        ).agg(["min", "max"]),
        "lines took {:.0f} % and discs {:.0f} %": lambda: (
            100 * costs()[["reduce_lines", "indent_surfaces"]] / costs().sum()
        ),
        "the largest job took {:.0f} GB": lambda: costs("memory_mb").max() / 1000,
    },
    "docs/solver.md": {
        "between {:.2f} and 1.4 for any set": lambda: LEAST_EIGENVALUE,
    },
}


@pytest.mark.parametrize(("page", "sentence"), [(page, text) for page, rows in QUOTED.items() for text in rows])
def test_numbers_on_pages_agree_with_the_tables(page, sentence):
    numbers = np.ravel(np.asarray(QUOTED[page][sentence](), dtype=object))
    assert sentence.format(*numbers) in words(page)


def test_most_single_discs_lie_in_their_interval():
    """The interval was calibrated on other discs. It should contain 95 % of them."""
    table = publish.largest_errors().query("tested > 0")
    assert set(table["across"]) == {129, 257}
    for name in ("velocity", "depth"):
        assert table[f"{name}_coverage"].between(0.9, 0.98).all(), name


def test_law_is_within_its_stated_error_on_fresh_discs():
    """The grid is the grid of the law. Errors may exceed the stated ones by two standard errors of their mean."""
    table = published("law_errors.csv").query("across == 257")
    for name in ("velocity", "depth"):
        stated = table["hurst"].map(lambda hurst, name=name: getattr(penetration_law(hurst), f"{name}_error"))
        assert (table[f"{name}_error"].abs() <= stated + 2 * table[f"{name}_standard_error"]).mean() >= 0.95


def test_tolerances_on_the_page_of_verdicts_agree_with_the_claims():
    for name, tolerance in re.findall(r"`(\w+)`: ([\d.]+)", words("docs/verdicts.md")):
        assert CLAIMS[name]["tolerance"] == float(tolerance)


def test_conclusions_on_pages_follow_from_the_tables():
    """These statements are in words or rounded numbers, and change only if an assertion fails."""
    # Verdicts and the power law.
    assert set(value("zeta_better", column="verdict")) == {"reproduced"}
    assert "not reproduced" in set(value("master_curve_shape", column="verdict"))
    assert value("alpha_limit", "H = 1, discs", "verdict") == "undecided"
    plateaus = dict(tuple(published("plateaus.csv").groupby("case_group")))
    assert plateaus["base"]["power_law_passes"].min() >= 0.95
    assert plateaus["base"]["control_passes"].max() == 0
    assert plateaus["base"]["decades_low"].min() >= 1.5 > plateaus["roll_off"]["decades_low"].max()
    assert 1.5 <= plateaus["roll_off"]["decades_high"].max() < 2
    assert (value("power_law_decades", column="low") >= 2).tolist() == [False, True, True, True]
    assert set(LAW.index) == set(plateaus["roll_off"]["hurst"]) | {1.0} == {0.1, 0.4, 0.6, 0.9, 1.0}
    # Boundary elements and the MDR.
    assert value("coincide").abs()[["H = 0.6", "H = 0.9"]].max() < 0.02
    assert value("coincide_equal_windows").abs().iloc[:2].between(0.07, 0.085).all()
    assert published("reduction.csv")["stiffness_ratio"].between(0.75, 1.25).all()
    assert (PAPER["lines"]["points"], DEFAULT["lines"]["points"]) == (4_000_000, 131_072)
    assert 3e4 < value("contact_problems", "changes of the contact") < 4.5e4
    # Grids.
    judged = published("fine_exponents.csv").query("judged == 1 and quantity == 'whole'").set_index("hurst")
    assert judged.index.tolist() == [0.1, 0.4, 0.6, 0.9, 1.0]
    assert ((judged["beta_high"] - judged["beta_low"]) / 2).drop(0.1).max() < 0.04
    for window in ("X = 0.001 to 0.01", "X = 0.003 to 0.03"):
        assert trends(window)["lines", 0.1] < 0
    assert plateau().filter(like="u0_").sub(plateau()["u0"], axis=0).abs().max(axis=None) <= 0.02
    # Costs.
    assert default_path()["error"].max() <= 1e-3
    assert default_path()["wall_s"].between(0.05, 0.15).all()
    assert max(curve["force_error"] for curve in BENCHMARKS["curve"]) < 2e-5
    assert (large([4097, 8193])["memory"] / large([4097, 8193])["elements"]).max() < 200
