"""The numbers that README and docs/ quote are those of the published tables."""

import json
import re
from functools import cache

import numpy as np
import pandas as pd
import publish
import pytest
from scipy.special import ndtri

from support.documentation import ROOT, read
from support.study import CLAIMS
from support.workflow import merged, read_settings
from viscorough.cli.surface_options import _STEEP_SLOPE
from viscorough.contact.step_control import _RELAXED_BOUND
from viscorough.reference import exponent_beta, zeta_elastic
from viscorough_study.ensembles.flat_punch import punch_stiffness
from viscorough_study.performance.costs import fit_cost
from viscorough_study.run.cases import disc_cases
from viscorough_study.verdicts.claims import overall
from viscorough_study.verdicts.evidence import FEW_WIDENED

TABLE = pd.read_csv(ROOT / "docs/claims.csv")
LAW = pd.read_csv(ROOT / "src/viscorough/data/law.csv").query("across == 257").set_index("hurst")
INTERVAL = ["value", "low", "high"]
BASE = "source == 'discs' and case_group == 'base' and rms_convention == 'disc' and average == 'geometric'"


@cache
def words(page):
    return " ".join(read(ROOT / page).split())


@cache
def published(name):
    """A table of docs/results."""
    return pd.read_csv(ROOT / "docs/results" / name)


def value(claim, case=slice(None), column="value"):
    """Values of a claim by case, or that of one case."""
    return TABLE[TABLE["claim"] == claim].set_index("case")[column].loc[case]


def ends(values, places=0, factor=1):
    """The least and the largest of values, rounded."""
    return [f"{factor * end:.{places}f}" for end in (values.min(), values.max())]


def percents(ratios):
    """Deviations of the least and the largest ratio from 1."""
    return [f"{100 * abs(end - 1):.0f}" for end in (ratios.min(), ratios.max())]


def fits(window_rule):
    return published("scaling.csv").query(BASE).query(f"window_rule == '{window_rule}'").set_index("hurst")


def over_expected(claim):
    return value(claim) / value(claim, column="expected")


def above(betas):
    """β less H/(1 + H), of a series by Hurst exponent."""
    return betas - betas.index.map(exponent_beta)


def plateau_of_interface():
    """u₀/h of discs on the paper's grid, by Hurst exponent."""
    rows = published("interface.csv").query("source == 'discs' and across == 257")
    return rows.drop_duplicates("hurst").set_index("hurst")


def claim_verdicts(claim, case=slice(None)):
    return set(np.atleast_1d(value(claim, case, "verdict")))


def departures():
    """β less H/(1 + H) of the calibrated law of discs, at H = 0.1 and 0.4."""
    law = pd.read_csv(ROOT / "src/viscorough/data/calibration.csv").query("source == 'discs'").set_index("hurst")
    return above(law["beta"])[[0.1, 0.4]]


def reduction(inside):
    """Discs beside their lines, over the whole range or in region (b)."""
    table, windows = published("reduction.csv"), fits("default")
    low, high = (table["hurst"].map(windows[name]) for name in ("x_low", "x_high"))
    return table[table["x"].between(low, high)] if inside else table


def largest(table):
    return (table["stiffness_ratio"] - 1).abs().max()


def plateaus(group):
    return published("plateaus.csv").query(f"case_group == '{group}'")


def limits():
    """Exponents of infinitely fine grids."""
    return published("infinite_grid.csv").query("law == 'corrected'")


def below_expected():
    """Those whose intervals in all ranges of X do not reach H/(1 + H)."""
    table = limits()
    return table[~table["expected"].between(table["ranges_low"], table["ranges_high"])].set_index("source")


def trends():
    """Change of β with ten times as many elements, by least squares weighted by the intervals, for every window."""
    table = published("sizes.csv").query("case_group == 'sizes' and average == 'geometric'").dropna(subset="beta")
    table = table[table["rms_convention"].isin(["disc", "line"])]
    table = table.assign(weight=1 / (table["beta_high"] - table["beta_low"]))
    slopes = {
        key: np.polyfit(np.log10(rows["elements"]), rows["beta"], 1, w=rows["weight"])[0]
        for key, rows in table.groupby(["source", "window_rule", "hurst"])
        if len(rows) > 2
    }
    return pd.Series(slopes).rename_axis(["source", "window_rule", "hurst"]).reset_index(name="slope")


def trends_at_fixed_x():
    """Largest change of β with ten times as many elements, in the fixed window."""
    return trends().query("window_rule == 'X = 0.01 to 0.1'")["slope"].abs().max()


def default_path():
    """Boundary elements at the default tolerance, on rough discs of 257 elements across."""
    return published("methods.csv").query(
        "method == 'path, automatic levels' and value == 1e-3 and elements == 257 and hurst.notna()", engine="python"
    )


def grid_change(quantity, column="factor"):
    """Change of a quantity with ten times as many elements, or ends of its interval, by Hurst exponent."""
    table = published("grid_dependence.csv").drop_duplicates(["hurst", "quantity"])
    return table[table["quantity"] == quantity].set_index("hurst")[column]


def periodic(roll_off):
    """g of periodic surfaces around X = 1, by Hurst exponent."""
    table = published("periodic.csv").query("0.7 < x < 1.4")
    return table[table["roll_off_wavelength"].notna() == roll_off].groupby("hurst")["g"].mean()


def early():
    """Trends of lines in fixed windows at small X."""
    return trends().query("source == 'lines' and hurst == 0.1 and window_rule.str.match('X = 0.00')", engine="python")


def large(across, column):
    return published("large.csv").set_index("across").loc[across, column]


def cost_of_large(across, seconds):
    """Wall time in so many seconds, and GB."""
    return [large(across, "wall") / seconds, large(across, "memory") / 1e9]


def growth_of_large(across, column):
    return fit_cost(large(across, "elements"), large(across, column))[0]


def beyond(column):
    """A cost of 16 385 elements across, if it goes on to grow as from 4097 to 8193."""
    return large(8193, column) * (large(8193, column) / large(4097, column))


def placed(choice):
    """Times of levels placed otherwise over those of automatic ones, scene by scene, the least first."""
    table = published("level_placement.csv").query("reached == 1")
    return table.pivot(index="scene", columns="choice", values="ratio")[choice].sort_values()


def costs(column="seconds"):
    return published("rule_costs.csv").set_index("rule")[column]


def two_threads():
    two = published("other_solvers.csv").query("solver != 'viscorough' and threads == 2")
    return two.groupby(["task", "hurst"])["ratio"].min()


def light_loads():
    """Other solvers under one light load, those that finished."""
    return published("light_contact.csv").query("solver != 'viscorough'")


def discs_of_paper():
    """Number of discs of the paper's scale, by group."""
    cases = disc_cases(merged(read_settings("config"), read_settings("paper"))).values()
    discs = [(case["group"], ensemble["realizations"]) for case in cases for ensemble in case["ensembles"]]
    return pd.DataFrame(discs, columns=["group", "number"]).groupby("group")["number"].sum()


def line_over_disc():
    """Cost of a line over that of a disc."""
    return costs()["reduce_lines"] / 50500 / (costs()["indent_surfaces"] / discs_of_paper().sum())


def minutes_of_paper():
    return re.search(r"`make paper` repeats .*?, in (\d+) minutes", words("README.md"))[1]


def minutes_of_reproduction():
    return re.search(r"which shows them; ([\d.]+) minutes", words("docs/reproduce.md"))[1]


def benchmarks(key):
    """A key of `make bench`: a column for every quantity, or for every problem."""
    return pd.DataFrame(json.loads(read(ROOT / "docs/results/benchmarks.json"))[key])


def other_times():
    return pd.read_csv(ROOT / publish.OTHER_SOLVERS)["ratio"]


# {page: {sentence: what fills its brackets, a text, a number or a list of them; or whether it is true}}
QUOTED = {
    "README.md": {
        "ζ is {} to {} % above": lambda: percents(over_expected("zeta_elastic")),
        "{} to {} % below the second": lambda: percents(over_expected("zeta_viscous"))[::-1],
        "at H = 0.4 and 0.1 it is {:.2f} and {:.2f} larger": lambda: above(fits("default")["beta"])[[0.4, 0.1]],
        "in region (b) to {:.0f} %": lambda: 100 * value("exact_correspondence").abs().max(),
        "F/({:.2f} h)": lambda: plateau_of_interface()["u0"].mean(),
        "within 5 % from X = {:.1g} to {:.0f} at every H": lambda: [LAW["x_low"].max(), LAW["x_high"].min()],
        "and from {:.1g} to {:.0f} but for H = 1": lambda: [LAW["x_low"].drop(1).max(), LAW["x_high"].drop(1).min()],
        "take {:.0f} to {:.0f}": lambda: [other_times().min(), 10 * round(other_times().max() / 10)],
        "{} minutes here": minutes_of_reproduction,
        "at about a fifth of the cost": lambda: 0.17 < line_over_disc() < 0.23,
        "to 0.1 % in about 0.1 s (257 elements": lambda: (
            default_path()["error"].max() <= 1e-3 and default_path()["wall_s"].between(0.05, 0.15).all()
        ),
    },
    "docs/getting_started.md": {"It takes {} minutes": minutes_of_reproduction},
    "docs/verdicts.md": {
        "*ζ* as defined here is {} to {} % above Eq. 4": lambda: percents(over_expected("zeta_elastic")),
        "at equal contact stiffness {} to {} %": lambda: percents(
            fits("kappa")["zeta"] / fits("kappa").index.map(zeta_elastic)
        ),
        "its quantity is {:.3f}, with {:.3f} to {:.3f}, beside the end of its tolerance, {:g}": lambda: value(
            "zeta_elastic_shape", "all H", [*INTERVAL, "tolerance"]
        ),
        "over {:.3g} decades, {:.3g} to {:.3g}": lambda: value("power_law", "H = 0.1, decades", INTERVAL),
        "two decades at every *H*": lambda: (value("power_law", column="low").drop("H = 0.1, decades") >= 2).all(),
        "only {} to {} % of the elements touch": lambda: ends(value("complete_contact"), factor=100),
        "take some hundred times as long as the lines": lambda: 50 < value("computing_time").iloc[0] < 1000,
        "with about {:.0f} contact problems": lambda: 51432 * value("contact_problems").iloc[0],
        "above *H*/(1 + *H*), by {:.2f} and {:.2f}": lambda: departures(),
        "discs have {:.3f}, {:.3f} to {:.3f}": lambda: value("alpha_limit", "H = 1, discs", INTERVAL),
        "The control falls short of two decades at every *H*": lambda: plateaus("roll_off")["decades_high"].max() < 2,
        "with 1.5 decades *H* = 0.1 would pass": lambda: plateaus("base")["decades_low"].min() >= 1.5,
        "and the control would be undecided": lambda: (
            plateaus("roll_off")["decades_high"].max() >= 1.5 > plateaus("roll_off")["decades_low"].max()
        ),
        "own scale: {} discs and 50 500 lines": lambda: discs_of_paper()["base"],
        "`make paper` has {:.0f} discs, twice the paper's {:.0f} |": lambda: (
            discs_of_paper()["base"] / np.array([1, 2])
        ),
        "than the paper: {:.0f} discs for every *H*, of which {:.0f} go on to region (c), and {} lines": lambda: [
            9 * read_settings("config")["discs"]["realizations"],
            9 * read_settings("config")["discs"]["whole_curves"],
            read_settings("config")["lines"]["realizations"],
        ],
        "in less than {:.2f} % of all draws": lambda: 100 / (FEW_WIDENED * ndtri(0.975)) ** 2 + 0.005,
        "`elements`: {:g} elements are allowed": lambda: CLAIMS["elements"]["tolerance"],
        "`bodies_of_revolution`: {:g}, not": lambda: CLAIMS["bodies_of_revolution"]["tolerance"],
        "`last_region`: {:g}, not": lambda: CLAIMS["last_region"]["tolerance"],
        "`coincide_equal_windows`: {:g}, not": lambda: CLAIMS["coincide_equal_windows"]["tolerance"],
    },
    "docs/verification.md": {
        "factors of {:.2f}, {:.2f}, {:.2f} and {:.2f}": lambda: value("lambda_constant"),
        "of {:.0f}, {:.0f}, {:.0f} and {:.0f} %, and": lambda: 100 * value("exact_correspondence").abs(),
        "up to {:.0f}, {:.0f}, {:.0f} and {:.0f} % |": lambda: 100 * value("whole_curve").abs(),
        "within {:.2f}": lambda: value("coincide_equal_windows").abs().iloc[2:].max(),
        "{} to {} times too large": lambda: ends(value("line_area")),
        "{} to {} of that of the discs": lambda: ends(value("line_gap"), 2),
        "in region (b) to 20 %, beyond it to 25 %": lambda: (
            largest(reduction(inside=True)) < 0.2 and largest(reduction(inside=False)) < 0.25
        ),
        "to a factor of {} to {} in region (b)": lambda: ends(np.exp(reduction(inside=True)["stiffness_scatter"]), 1),
        "up to {:.0f} below it": lambda: np.exp(reduction(inside=False)["stiffness_scatter"].max()),
        "above *H*/(1 + *H*), by {:.2f} and {:.2f}": lambda: departures(),
        "by {:.2f} and {:.2f}": lambda: value("coincide").abs()[["H = 0.1", "H = 0.4"]],
        "as many elements change it by at most {:.3f}, at any": lambda: trends_at_fixed_x(),
        "in `make paper`, where both are": lambda: 0.17 < line_over_disc() < 0.23,
        "by {} to {}": lambda: ends(early()["slope"].abs(), 3),
        "which would be {} to {}": lambda: ends(value("gamma", column="expected"), 2),
        "*u*/*h* = 1 by {:.2f} at *H* = 0.1 and by {:.2f} at": lambda: grid_change("κ at u/h = 1")[[0.1, 0.4]],
        "the same, within {:.0f} %, from": lambda: (
            100 * abs(np.log(grid_change("κ at u/h = 1", ["factor_low", "factor_high"]).loc[[0.9, 1.0]])).max(axis=None)
        ),
        "change *vt*/*h* by at most {:.0f} %": lambda: 100 * (grid_change("vt/h at X = 0.1") - 1).abs().max(),
        "*u*/*h* grows by {:.0f} % at": lambda: 100 * (grid_change("u/h at X = 0.1")[0.1] - 1),
    },
    "docs/theory.md": {
        "changes *ζ* by {} to {} %": lambda: percents(value("gamma", column="expected")),
        "*u*₀/*h* is known to ±0.02 at every *H*": lambda: (
            plateau_of_interface().filter(like="u0_").sub(plateau_of_interface()["u0"], axis=0).abs().max(axis=None)
            <= 0.02
        ),
        "it is {:.2f}, {:.2f} and {:.2f} at *H* = 0.1, 0.6 and 0.9": lambda: periodic(roll_off=False),
        "a plateau of {:.2f} to {:.2f}. So": lambda: plateau_of_interface()["u0"].agg(["min", "max"]),
        "period it is {:.2f}, {:.2f} and {:.2f}": lambda: periodic(roll_off=True),
        "below 2e-5 at the default": lambda: benchmarks("curve")["force_error"].max() < 2e-5,
        "rms slope above about {}": lambda: str(_STEEP_SLOPE),
        "Up to {} times the bound": lambda: str(_RELAXED_BOUND),
        "softer by about 1.3/*n*": lambda: all(
            abs(number * (1 - punch_stiffness(number)) - 1.3) < 0.06 for number in (33, 257)
        ),
    },
    "docs/outside.md": {
        "changes {:.0f} times as much without": lambda: np.divide(
            *abs(published("outside.csv").set_index("quantity")["ours"])[
                [f"change of {area}/A₀ from 128² to 512²" for area in ("A", "A*")]
            ]
        ),
    },
    "docs/scaling.md": {
        "at {:.3f} for discs and {:.3f} for lines": lambda: below_expected()["ranges_low"][["discs", "lines"]],
        "| {:.0f} s, {:.0f} operator applications, {:.0f} levels |": lambda: large(
            4097, ["wall", "operator_applications", "levels"]
        ),
        "from {:.0f} at 257 elements across to {:.0f} at": lambda: large([257, 4097], "operator_applications"),
        "elements to the power {:.1f}, to which": lambda: growth_of_large([257, 4097], "wall"),
        "| {:.1f} GB; between 2049 and 4097 it grows as the number of elements to the power {:.2f}": lambda: [
            large(4097, "memory") / 1e9,
            growth_of_large([2049, 4097], "memory"),
        ],
        "between 4097 and 8193 to the power {:.2f}": lambda: growth_of_large([4097, 8193], "memory"),
        "at most 200 bytes": lambda: (large([4097, 8193], "memory") / large([4097, 8193], "elements")).max() < 200,
    },
    "docs/solver.md": {
        "{:.0f} at 257 elements across, {:.0f} at 4097 and {:.0f} at 8193": lambda: (
            large([257, 4097, 8193], "operator_applications") / (large([257, 4097, 8193], "levels") - 400)
        ),
    },
    "docs/questions.md": {
        "4097 elements across takes {:.0f} s and {:.1f} GB": lambda: cost_of_large(4097, 1),
        "at about a fifth of the cost": lambda: 0.17 < line_over_disc() < 0.23,
        "takes {:.2f} to {:.2f} s for a disc of 257": lambda: default_path()["wall_s"].agg(["min", "max"]),
        "elements change it by at most {:.3f}. At": lambda: trends_at_fixed_x(),
        "At smaller *X* and small *H* it falls": lambda: (early()["slope"] < 0).all(),
    },
    "docs/reproduce.md": {
        "50 500 lines: {} minutes": minutes_of_paper,
        "{0[base]} discs for the figures, {1} for variants and grids": lambda: [
            discs_of_paper(),
            discs_of_paper().drop("base").sum(),
        ],
    },
    "docs/performance.md": {
        "Of {} min": minutes_of_paper,
        "takes {} to {} times as long as its applications": lambda: ends(benchmarks("over_operators")["ratio"], 1),
        "the contact at one force {:.1f} s": lambda: benchmarks("large_map")["contact"]["wall_s"],
        "50 % contact takes {:.0f} s, and": lambda: benchmarks("large_map")["curve"]["wall_s"],
        "4097 elements across takes {:.0f} s up to 50 % contact and {:.1f} GB, on one": lambda: cost_of_large(4097, 1),
        "on one thread, {:.0f} s on two": lambda: large(4097, "wall_threads"),
        "{:.0f} minutes and {:.1f} GB, on two threads {:.1f} minutes": lambda: [
            *cost_of_large(8193, 60),
            large(8193, "wall_threads") / 60,
        ],
        "would take about 90 minutes": lambda: 85 < beyond("wall") / 60 < 95,
        "90 minutes and {:.0f} GB on one thread": lambda: beyond("memory") / 1e9,
        "On a disc of 2049 two threads are {:.2f} times as fast": lambda: (
            large(2049, "wall") / large(2049, "wall_threads")
        ),
        "to the power {:.2f} from 129 to 4097 (`make large`)": lambda: growth_of_large(slice(129, 4097), "wall"),
        "at most {:.3g} times the time of the best levels placed by hand": lambda: 1 / placed("best by hand").iloc[0],
        "at most {:.3g} times in the others": lambda: 1 / placed("best by hand").iloc[1],
        "at least {:.2g} times the time of the automatic ones": lambda: placed("naive").iloc[0],
        "lines took {:.0f} % and discs {:.0f} %": lambda: (
            100 * costs()[["reduce_lines", "indent_surfaces"]] / costs().sum()
        ),
        "the largest job took {:.0f} GB": lambda: costs("memory_mb").max() / 1000,
        "takes {:.2g} to {:.2g} times as long for the single levels": lambda: two_threads().agg(["min", "max"]),
        "Tamaas and ContactMechanics everywhere, and all at 30 % contact": lambda: (
            set(light_loads()["solver"]) == {"ASPHER active set"} and light_loads()["fraction"].max() < 0.3
        ),
    },
}


@pytest.mark.parametrize(("page", "sentence"), [(page, text) for page, rows in QUOTED.items() for text in rows])
def test_numbers_on_pages_are_those_of_the_tables(page, sentence):
    numbers = QUOTED[page][sentence]()
    if isinstance(numbers, (bool, np.bool)):
        assert numbers
    assert sentence.format(*np.atleast_1d(np.asarray(numbers, dtype=object))) in words(page)


def test_what_pages_conclude_from_the_tables():
    """Sentences without numbers, whose words change only if one of these does."""
    assert "reproduced under a stated convention" in claim_verdicts("zeta_better")
    assert "not reproduced" in claim_verdicts("master_curve_shape")
    assert claim_verdicts("alpha_limit", "H = 1, discs") == {"undecided"}
    assert value("coincide").abs()[["H = 0.6", "H = 0.9"]].max() < 0.02
    assert value("coincide_equal_windows").abs().iloc[:2].round(2).tolist() == [0.08, 0.08]
    assert set(LAW.index) == set(plateaus("roll_off")["hurst"]) | {1.0} == {0.1, 0.4, 0.6, 0.9, 1.0}
    assert plateaus("base")["power_law_passes"].min() >= 0.95
    assert plateaus("base")["control_passes"].max() == 0
    assert below_expected()[["quantity", "hurst", "omega_high"]].drop_duplicates().to_numpy().tolist() == [
        ["interface", 0.1, 1.5]
    ]
    assert set(limits().query("source == 'discs'")["finding"]) == {"undecided"}
    velocity = limits().query("source == 'lines' and quantity == 'whole'")
    assert (velocity["beta"] - velocity["expected"]).abs().max() < 0.01


def test_verdicts_of_other_seeds():
    """None changes with the seed."""
    seeds = json.loads(read(ROOT / "docs/seeds.json"))
    tables = pd.read_csv(ROOT / "docs/seeds.csv", keep_default_na=False, na_values=[""]).groupby("seed")
    assert {str(seed): overall(table) for seed, table in tables} == seeds["verdicts"]
    assert (len(seeds["verdicts"]), seeds["moved"]) == (3, {})
    assert all(list(verdicts) == list(CLAIMS) for verdicts in seeds["verdicts"].values())
