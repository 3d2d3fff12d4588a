"""The registry of figures and tables."""

from support.workflow import RESULTS
from viscorough_study.run.registry import Registry

FILE = {
    "chapters": {"fits": "5 Fits"},
    "figures": {
        "exponent": {"chapter": "fits", "input": {"pool": "ensembles/discs.nc", "table": "tables/a.csv"}},
        "scans": {"chapter": "fits", "input": {}, "target": "measured", "module": "measured", "file": "fig9"},
    },
    "tables": {
        "fit_power_laws": {"tables": {"scaling": {}}},
        "compare": {"function": "room.module.compare", "tables": {"a": {}, "b": {"columns": "room.module.B"}}},
        "press": {"function": "room.measured.press", "target": "measured", "tables": {"contacts": {}}},
        "tabulate_rule_costs": {"tables": {"rule_costs": {}}},
    },
}


def test_tables_of_a_target_leave_the_costs_out():
    registry = Registry(FILE)
    assert registry.tables("all") == ["scaling", "a", "b"]
    assert registry.tables("measured") == ["contacts"]


def test_columns_are_those_of_the_module_by_default():
    functions = Registry(FILE).table_functions("compare")
    assert functions == {"tabulate": "room.module.compare", "a": "room.module.COLUMNS", "b": "room.module.B"}


def test_figures_name_their_module_and_the_readers_of_other_files():
    registry, figures = Registry(FILE), "viscorough_study.figures"
    functions = {"draw": f"{figures}.exponent.plot_exponent", "pool": f"{figures}.inputs.pool"}
    assert registry.figure_functions("exponent") == functions
    assert registry.figure_functions("scans") == {"draw": f"{figures}.measured.plot_measured"}
    assert (registry.figures["exponent"]["file"], registry.figures["scans"]["file"]) == ("exponent", "fig9")


def test_every_chapter_of_a_figure_is_a_category_of_the_report():
    registry = Registry(RESULTS)
    assert {figure["chapter"] for figure in registry.figures.values()} <= set(registry.chapters)
