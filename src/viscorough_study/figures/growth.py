"""Growth of the cost of the methods with the number of elements."""

import numpy as np

from viscorough_study.figures import style
from viscorough_study.performance.costs import fit_cost, median_costs

# {(method, value of its parameter): label} of the costs drawn
METHODS = {
    ("path, automatic levels", 1e-3): "automatic levels, 1e-3",
    ("path, at the depths", 1e-6): "given depths, 1e-6",
    ("path, each depth alone", 1e-6): "each depth alone, 1e-6",
    ("path, uniform levels", 32): "32 uniform levels",
    ("explicit, logarithmic steps", 256): "256 explicit steps",
    ("SlipPY", 1e-6): "SlipPY, 1e-6",
    ("ASPHER", 1e-6): "ASPHER, 1e-6",
}


@style.figure
def plot_growth(table):
    """Wall time and operator applications against the number of elements of rough discs, with fitted exponents.

    table : of viscorough_study.performance.measurement
    Medians over the discs of one size.
    """
    figure = style.new_figure(85)
    time, operators = figure.subplots(1, 2)
    looks = style.series_looks(METHODS.values())
    for (method, value), label in METHODS.items():
        costs, look = median_costs(table, method, value), looks[label]
        if costs.empty:
            continue
        exponent, _ = fit_cost(costs["number"], costs["wall_s"])
        note = "" if np.isnan(exponent) else f": $N^{{{exponent:.2f}}}$"
        time.plot(costs["number"], costs["wall_s"], **look, label=label + note)
        if costs["operator_applications"].any():
            operators.plot(costs["number"], costs["operator_applications"], **look)
    time.set(ylabel="wall time (s)")
    operators.set(ylabel="operator applications on the grid")
    for axes in (time, operators):
        axes.set(xscale="log", yscale="log", xlabel="elements of the disc $N$")
    figure.legend(loc="outside lower center", ncols=3)
    return figure
