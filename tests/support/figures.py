"""Tables for the figures, most of them published, and measures of the drawn figures."""

from importlib import import_module

import numpy as np
import pandas as pd
from matplotlib.backends.backend_agg import FigureCanvasAgg

from support.study import SHOWN
from support.workflow import FIGURES, ROOT
from viscorough.law.calibrated_law import CONSTANTS, interface_velocity, penetration_law
from viscorough_study.comparisons.histories import FORCE_CURVE, RECOVERY
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.fits.fine_sentence import PUBLISHED, judged_rows
from viscorough_study.fits.fit_table import COLUMNS as SCALING_COLUMNS

HURST = (0.4, 0.9)
COMBINATIONS = {
    "c1": {"force": 1.0, "viscosity": 1e6, "diameter": 1e-2, "rms": 1e-6},
    "c9": {"force": 300.0, "viscosity": 3e7, "diameter": 3e-2, "rms": 3e-7},
}
X = abscissa(1e-4, 30, 20)
ELEMENTS = 33
MODULES = {file: rule.removeprefix("plot_") for file, rule in FIGURES.items()}  # modules of the figures


def case_of(hurst, name):
    """Return the name of a case as the workflow gives it."""
    return f"h{round(hurst * 1e4):05d}_{name}"


CASES = {case_of(hurst, name): at for hurst in HURST for name, at in COMBINATIONS.items()}


def plot(module, *arguments, **options):
    """Draw the figure of a module of viscorough_study.figures from these arguments."""
    return getattr(import_module(f"viscorough_study.figures.{module}"), f"plot_{module}")(*arguments, **options)


# ---- contents of a figure


def drawn_points(axes):
    """Return every point of the lines, intervals, bands and bars of an axes."""
    paths = [path for collection in axes.collections for path in collection.get_paths()]
    bars = [patch.get_bbox().p1[None] for patch in axes.patches]
    return np.concatenate([*(line.get_xydata() for line in axes.lines), *(path.vertices for path in paths), *bars])


def whole_on_page(figure):
    """Return True if nothing in the figure reaches beyond the page after its layout."""
    figure.get_layout_engine().execute(figure)
    box, (width, height) = figure.get_tightbbox(FigureCanvasAgg(figure).get_renderer()), figure.get_size_inches()
    return box.x0 > -0.01 and box.y0 > -0.01 and box.x1 < width + 0.01 and box.y1 < height + 0.01


def dashed(axes):
    return [line for line in axes.lines if line.get_linestyle() == "--"]


# ---- tables


def published(name):
    """Return a published table, which is in docs/results, or in resources/published if the workflow reads it."""
    folder = "resources/published" if name == "reduction" else "docs/results"
    return pd.read_csv(ROOT / f"{folder}/{name}.csv")


def combinations_of(**values):
    """Return the table of all combinations of the values of columns."""
    return pd.MultiIndex.from_product(values.values(), names=values).to_frame(index=False)


def without_region(scaling, hurst):
    """Return the scaling table with no region (b) for one Hurst exponent, as the workflow writes it."""
    numbers = [name for name, (_, units) in SCALING_COLUMNS.items() if units and name not in ("hurst", "realizations")]
    return scaling.mask((scaling["hurst"] == hurst).to_numpy()[:, None] & np.isin(scaling.columns, numbers))


def media_table():
    """Return a table of two media in which the velocity is a power of time."""
    media, time = ("newtonian", "standard_linear_solid"), np.geomspace(1e-3, 1e3, 13)
    table = combinations_of(medium=media, hurst=HURST, time=time)
    power = table["time"] ** table["hurst"]
    return table.assign(x=1e-2 * table["time"], depth=power, velocity=power, realizations=6)


def slopes_table():
    """Return the ends of region (b) of discs and of a control at the Hurst exponents of the ensembles."""
    return combinations_of(case_group=("base", "roll_off"), hurst=HURST).assign(x_low=1e-2, x_high=0.2)


def histories_table():
    """Return motions of two durations with few times, in which symbols lie 1 % above the lines."""
    motions, time = (FORCE_CURVE, RECOVERY), np.linspace(-1.0, 10.0, 23)
    table = combinations_of(motion=motions, hurst=HURST, duration=(0.1, 10.0), time=time)
    table = table.assign(depth=2 + table["hurst"] - 0.1 * table["time"], force=table["duration"] + table["time"] ** 2)
    return table.assign(direct=1.01 * table["depth"].where(table["motion"] == RECOVERY, table["force"]))


def measured_kinetics():
    """Return a table of two scans of one group under two forces in two media."""
    scans, media, time = ("polished_1", "polished_2"), ("newtonian", "maxwell"), np.geomspace(1e-3, 1e3, 13)
    table = combinations_of(scan=scans, medium=media, force=(0.1, 1.0), time=time).assign(group="polished")
    return table.assign(depth=1e-6 * table["force"] * table["time"], velocity=1e-6 * table["force"])


def interface_curves():
    """Return curves of the published interfaces in series with a punch; the law is 2 % above them."""
    x, curves = np.geomspace(1e-3, 28, 60), []
    for (*labels, hurst), _ in published("interface").groupby(["source", "across", "hurst"]):
        law = penetration_law(hurst)
        interface = interface_velocity(x, *(getattr(law, name) for name in CONSTANTS)) / 1.02
        curve = {"x": x, "interface": interface, "interface_low": 0.9 * interface, "interface_high": 1.1 * interface}
        curve |= dict(zip(("source", "across"), labels, strict=True))
        curves.append(pd.DataFrame(curve).assign(hurst=hurst))
    return pd.concat(curves, ignore_index=True)


OTHER_SOLVERS = pd.read_csv(ROOT / "resources/published/other_solvers.csv").to_dict("records")
FINE_GRIDS = judged_rows(ROOT)
FROM_TABLES = {  # arguments of the figures that are drawn from tables alone
    "direct": (published("direct"),),
    "failures": (published("failures"),),
    "fig4_exponent": (published("scaling"), SHOWN, (0.4, 1.0), FINE_GRIDS),
    "histories": (histories_table(),),
    "interface": (published("interface"), interface_curves(), published("literature"), published("periodic")),
    "local_exponent": (pd.read_csv(ROOT / PUBLISHED),),
    "mdr_lambda": (published("mdr_lambda"), published("mdr_exponents")),
    "media": (media_table(),),
    "reduction": (published("reduction"),),
    "speed": (published("mean_accuracy"), OTHER_SOLVERS),
    "validation": (published("validation"),),
}
