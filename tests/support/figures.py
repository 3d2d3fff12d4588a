"""Small tables for the figures, and what the figures made from them show."""

from importlib import import_module
from itertools import product

import numpy as np
import pandas as pd
from matplotlib.backends.backend_agg import FigureCanvasAgg

from support.study import SHOWN, fit_row
from support.workflow import RESULTS
from viscorough.calibrated_law import CONSTANTS, interface_velocity, penetration_law
from viscorough_study.comparisons.literature import COLUMNS as LITERATURE
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.figures.failure_map import LETTERS
from viscorough_study.fits.conventions import source_values
from viscorough_study.fits.fit_table import COLUMNS as SCALING_COLUMNS
from viscorough_study.fits.interface import COLUMNS as INTERFACE
from viscorough_study.fits.scaling_collapse import QUANTITIES, Grid, curve_table
from viscorough_study.performance import measurement

HURST = (0.4, 0.9)
COMBINATIONS = {
    "c1": {"force": 1.0, "viscosity": 1e6, "diameter": 1e-2, "rms": 1e-6},
    "c9": {"force": 300.0, "viscosity": 3e7, "diameter": 3e-2, "rms": 3e-7},
}
X = abscissa(1e-4, 30, 20)
ELEMENTS = 33


def case_of(hurst, name):
    """Name of a case as the workflow gives it."""
    return f"h{round(hurst * 1e4):05d}_{name}"


MODULES = {  # of the figures of the report, by their files
    figure.get("file", name): figure.get("module", name) for name, figure in RESULTS["figures"].items()
}


def plot(module, *arguments, **options):
    """The figure that a module of viscorough_study.figures draws from these arguments."""
    return getattr(import_module(f"viscorough_study.figures.{module}"), f"plot_{module}")(*arguments, **options)


# ---- what a figure shows


def whole_on_page(figure):
    """Whether nothing that is drawn reaches beyond the page, once laid out."""
    figure.draw_without_rendering()
    box, (width, height) = figure.get_tightbbox(FigureCanvasAgg(figure).get_renderer()), figure.get_size_inches()
    return box.x0 > -0.01 and box.y0 > -0.01 and box.x1 < width + 0.01 and box.y1 < height + 0.01


def coordinates(axes):
    """Coordinates of all lines of an axes."""
    return [line.get_xydata() for line in axes.lines]


def dashed(axes):
    return [line for line in axes.lines if line.get_linestyle() == "--"]


def markers(axes):
    """Markers without a line."""
    return [line for line in axes.lines if line.get_marker() in "os^D" and line.get_linestyle() == "None"]


def legend_texts(legend):
    return [text.get_text() for text in legend.get_texts()]


# ---- tables


def combinations_of(**values):
    """Table of all combinations of the values of columns."""
    return pd.MultiIndex.from_product(values.values(), names=values).to_frame(index=False)


def without_region(scaling, hurst):
    """The scaling table with no region (b) for one Hurst exponent, as the workflow writes it."""
    numbers = [name for name, (_, units) in SCALING_COLUMNS.items() if units and name not in ("hurst", "realizations")]
    return scaling.mask((scaling["hurst"] == hurst).to_numpy()[:, None] & np.isin(scaling.columns, numbers))


def validation_table(grids=(33, 65, 129), quantities=("force", "depth")):
    """Errors of second order, 0.5/n² for the sphere, 0.7/n² for its reduction, 0.2/n² for the cone, which fails."""
    table = combinations_of(quantity=quantities, case=("sphere", "sphere_reduction", "cone"), elements=grids)
    error = table["case"].map({"sphere": 0.5, "sphere_reduction": 0.7, "cone": 0.2}) / table["elements"] ** 2
    order, passed = 2.04 if len(grids) > 2 else np.nan, (table["case"] != "cone").astype(int)
    return table.assign(error=error, order=order, expected_order=2, limit=1e-3, passed=passed)


def mdr_table():
    """Lines as stiff as their discs, ten times larger in contact, half as far apart, and without correlation."""
    x = np.geomspace(1e-4, 1, 5)
    columns = {"x": x, "stiffness_scatter": 0.3, "correlation": 0.0, "chance": 0.5, "realizations": 6}
    columns |= {"force_ratio": 1.0}
    for name, value in (("stiffness_ratio", 1.0), ("area_ratio", 10.0), ("gap_ratio", 0.5)):
        columns |= {name: value, f"{name}_low": value / 2, f"{name}_high": value * 2}
    return pd.concat([pd.DataFrame({"hurst": hurst, **columns}) for hurst in (0.4, 0.9)], ignore_index=True)


def mdr_lambda_tables():
    """λ = 2 in region (b) and more beyond it; exponents that differ in one window and are unknown in another."""
    x = np.geomspace(1e-3, 10, 9)
    lambdas, difference = {"x": x, "in_region": (x < 0.1).astype(int)}, np.array([-0.1, 0.0, np.nan])
    for name, value in (("lambda", 2 + x), ("velocity_ratio", 1 / (1 + x))):
        lambdas |= {name: value, f"{name}_low": value / 1.1, f"{name}_high": value * 1.1}
    exponents = {"window": ["own region", "same X", "same κ"], "difference": difference}
    exponents |= {"difference_low": difference - 0.05, "difference_high": difference + 0.05}
    two = pd.DataFrame({"hurst": (0.4, 0.9)})
    return [two.merge(pd.DataFrame(table), how="cross") for table in (lambdas, exponents)]


def direct_table():
    """Depths that are the elastic ones."""
    table = combinations_of(case=("sphere", "rough disc, H = 0.4"), contact_count=(10, 100))
    return table.assign(depth_ratio=1.0, with_gamma=1.1)


def methods_table():
    """Costs of five methods on a rough disc and a sphere of three sizes; the time of the first grows as N^1.2."""
    rows = [
        ("path, automatic levels", "path", 1e-3, np.nan, 1e-3),
        ("path, at the depths", "path", 1e-1, 0.01, 1e-2),
        ("path, at the depths", "path", 1e-6, 0.02, 0.0),
        ("explicit, uniform steps", "marching", 16, 0.5, 0.5),
        ("MDR", "model", 64, 0.001, 0.3),
    ]
    methods = pd.DataFrame(rows, columns=["method", "group", "value", "wall_s", "error"])
    table = combinations_of(problem=("rough disc, H = 0.4", "sphere"), elements=(65, 257, 513))
    table = table.merge(methods, how="cross")
    wall = table["wall_s"].fillna(1e-6 * table["elements"] ** 2.4)
    table = table.assign(hurst=table["problem"].map({"rough disc, H = 0.4": 0.4}), wall_s=wall, processor_s=wall)
    table = table.assign(operator_applications=table["elements"])
    return table.assign(steps=1, memory=1, parameter="")[list(measurement.COLUMNS)]


def other_solvers_table():
    rows = [("eight levels", 0.4, "viscorough", 1, 1.0), ("eight levels", 0.4, "ASPHER", 1, 3.5)]
    rows += [("eight levels", 0.4, "ASPHER", 2, 2.5), ("one level", 0.4, "viscorough", 1, 1.0)]
    table = pd.DataFrame(rows, columns=["task", "hurst", "solver", "threads", "ratio"])
    table = table.assign(ratio_low=0.9 * table["ratio"], ratio_high=1.1 * table["ratio"], met=1)
    missed = {"task": "one level", "hurst": 0.4, "solver": "SlipPY", "threads": 1, "met": 0}
    return pd.concat([table, pd.DataFrame([missed])])


def light_contact_table():
    """Two loads on maps of two sizes, a third and ASPHER on the larger one; the time grows as N^1.5."""
    table = combinations_of(elements=(256, 1024), fraction=(5e-4, 5e-3), solver=("viscorough",), threads=(1, 2))
    table = table.assign(wall_s=1e-9 * table["elements"] ** 3.0, ranking_s=1e-3, ratio=1.0, met=1)
    largest = table[table["elements"] == 1024]
    other = largest.assign(solver="ASPHER active set", ratio=4.0 * largest["threads"], wall_s=np.nan)
    missed = other.assign(solver="Tamaas", met=0, ratio=np.nan)
    return pd.concat([table, largest.assign(fraction=0.3), other, missed], ignore_index=True)


def level_placement_table():
    """Three choices for a scene, of which the naive one does not reach the accuracy."""
    rows = [("full curve", "automatic", 1e-3, 1e-4, 1, 40, 1.0), ("full curve", "best by hand", 1e-3, 9e-4, 1, 16, 0.8)]
    rows += [("full curve", "naive", 1e-3, 2e-3, 0, 512, 20.0)]
    table = pd.DataFrame(rows, columns=["scene", "choice", "accuracy", "error", "reached", "levels", "ratio"])
    return table.assign(wall_s=0.05 * table["ratio"])


def sizes_table():
    """Discs and lines of two Hurst exponents on three grids, the coarsest without region (b), and one control.

    In a window of fixed X, all exponents are 0.35.
    """
    fixed = {"window_rule": "X = 0.01 to 0.1"}
    rows = [
        fit_row(case_group="sizes", hurst=hurst, beta=beta, beta_low=0.2, beta_high=0.4, realizations=realizations)
        | source_values(source)
        | {"elements": n}
        | window
        for source in ("discs", "lines")
        for hurst in (0.3, 0.7)
        for n, realizations, moving in ((100, 8, np.nan), (1000, 6, 0.3), (10000, 4, 0.31))
        for window, beta in (({}, moving), (fixed, 0.35))
    ]
    return pd.DataFrame([*rows, rows[2] | {"case_group": "controls", "beta": 0.01}])


def curves_of_sizes():
    """Curves X^(H/(1+H)) for two Hurst exponents on two grids, and less X for the interface."""
    log_x = np.log(10.0) * np.arange(-4, 0.1, 0.1)
    grids = {
        hurst: [
            Grid(number, 4, log_x, (hurst / (1 + hurst) * log_x + 0.5)[None], np.full(log_x.size, 20.0), 1.0, 1.0)
            for number in (33, 129)
        ]
        for hurst in (0.4, 0.9)
    }
    return curve_table(grids, 1.0)


def collapse_tables():
    """Tables of the collapse and of the infinitely fine grid for discs of two Hurst exponents."""
    labels = {"source": "discs", "x_high": 0.03}
    collapse, infinite = [], []
    for hurst, quantity in product((0.4, 0.9), QUANTITIES):
        row = labels | {"hurst": hurst, "quantity": quantity, "expected": hurst / (1 + hurst)}
        collapse.append(row | {"beta_low": row["expected"] - 0.02, "beta_high": row["expected"] + 0.02})
        for law in ("power", "corrected"):
            beta = row["expected"] + 0.03
            infinite.append(row | {"law": law, "beta": beta, "beta_low": beta - 0.05, "beta_high": beta + 0.05})
    collapse.append(collapse[-1] | {"hurst": 1.0, "beta_low": np.nan, "beta_high": np.nan})
    return pd.DataFrame(collapse), pd.DataFrame(infinite)


def large_table():
    """Costs of four sizes: time with a constant part, memory in proportion to the elements."""
    elements = np.array([1e3, 1e4, 1e5, 1e6])
    table = pd.DataFrame({"across": [36, 113, 357, 1128], "elements": elements})
    return table.assign(processor=1.0 + 1e-6 * elements**1.2, memory=400 * elements, threads=2, wall_threads=0.6)


def failure_table(verdicts):
    """One case for each verdict in two groups, which concern both of the two methods."""
    methods = pd.DataFrame({"method": ("path, dense", "explicit steps"), "error": (0.0, 1e-3)})
    rows = [("shape" if rank % 2 else "grid", f"case {rank}", verdict) for rank, verdict in enumerate(verdicts)]
    return pd.DataFrame(rows, columns=["group", "case", "verdict"]).merge(methods, how="cross")


def media_table():
    """Two media, in which the velocity is a power of time."""
    media, time = ("newtonian", "standard_linear_solid"), np.geomspace(1e-3, 1e3, 13)
    table = combinations_of(medium=media, hurst=HURST, time=time)
    power = table["time"] ** table["hurst"]
    table = table.assign(x=1e-2 * table["time"], depth=power, velocity=power)
    return table.assign(exponent=table["hurst"], creep_exponent=1.0, expected=0.5, realizations=6)


def measured_kinetics():
    """Two scans of one group under two forces in two media."""
    scans, media, time = ("polished_1", "polished_2"), ("newtonian", "maxwell"), np.geomspace(1e-3, 1e3, 13)
    table = combinations_of(scan=scans, medium=media, force=(0.1, 1.0), time=time).assign(group="polished")
    return table.assign(depth=1e-6 * table["force"] * table["time"], velocity=1e-6 * table["force"])


def fits_of_a_group(pooled, scaling):
    """Fits of one group of measured surfaces, which are the discs of the first Hurst exponent."""
    fits = scaling[(scaling["source"] == "discs") & (scaling["hurst"] == pooled[0]["hurst"].item())]
    return fits.assign(source="measured", case_group="polished")


def literature_table():
    """Table of published values of u₀/h: a law in H, one value for all H, and no value."""
    rows = [("One", 2007, 0.4, 0.5, 0.56), ("One", 2007, 0.9, 0.41, 0.46)]
    rows += [("One, Two, Three and Four", 2013, hurst, 0.4, 0.4) for hurst in (0.4, 0.9)]
    rows += [("Five", 2011, hurst, np.nan, np.nan) for hurst in (0.4, 0.9)]
    table = pd.DataFrame(rows, columns=["source", "year", "hurst", "theirs_low", "theirs_high"]).assign(quantity="u0")
    return table.assign(value=0.5, low=0.49, high=0.51).reindex(columns=list(LITERATURE))


def periodic_table():
    """Table of periodic surfaces of one Hurst exponent, with and without a roll-off."""
    table = pd.DataFrame({"x": [0.2, 1.0, 5.0], "g": [0.4, 0.5, 0.3], "hurst": 0.4})
    return pd.concat([table.assign(roll_off_wavelength=wavelength) for wavelength in (np.nan, 0.125)])


def interface_tables_drawn():
    """Tables of an interface in series with a punch, as fits.interface makes them; the law is 2 % above it."""
    x, rows, curves = np.geomspace(1e-3, 28, 60), [], []
    ensembles = [("discs", "base", h, 257) for h in (0.4, 0.9)]
    ensembles += [("discs", "sizes", h, n) for h in (0.4, 1.0) for n in (65, 257)]
    ensembles += [("lines", "lines", 0.4, 4096), ("lines", "sizes", 0.4, 64)]
    for source, group, hurst, across in ensembles:
        labels = {"source": source, "case_group": group, "hurst": hurst, "across": across}
        constants = (getattr(penetration_law(hurst), name) for name in CONSTANTS)
        interface = interface_velocity(x, *constants) / 1.02
        plateau = {"u0": 0.48 + across / 1e4, "u0_low": 0.47, "u0_high": 0.53}
        plateau |= {"plateau_low": 0.4, "plateau_high": 1.2}
        rows.append(labels | plateau | {"kappa_c": 1.0})
        parts = {"x": x, "interface": interface, "interface_low": 0.9 * interface, "interface_high": 1.1 * interface}
        curves.append(pd.DataFrame(parts).assign(**labels))
    return pd.DataFrame(rows).reindex(columns=list(INTERFACE)), pd.concat(curves, ignore_index=True)


FROM_TABLES = {  # arguments of the figures that are drawn from tables alone
    "collapse": (curves_of_sizes(), *collapse_tables()),
    "direct": (direct_table(),),
    "failure_map": (failure_table(LETTERS),),
    "interface": (*interface_tables_drawn(), literature_table(), periodic_table()),
    "large": (large_table(),),
    "level_placement": (level_placement_table(),),
    "reduction": (mdr_table(),),
    "mdr_lambda": mdr_lambda_tables(),
    "light_contact": (light_contact_table(),),
    "media": (media_table(),),
    "media_exponents": (media_table(),),
    "other_solvers": (other_solvers_table(),),
    "sizes": (sizes_table(), SHOWN),
    "speed": (methods_table(),),
    "validation": (validation_table(),),
}
