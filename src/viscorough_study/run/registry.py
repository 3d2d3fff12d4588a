"""Hold the registry of figures and tables (workflow/results.yaml), and add default values for missing keys."""

_FIGURE = {"target": "all", "params": []}
_RULE = {"target": "all", "input": {}, "memory": 1000, "queued": False, "alone": False}


class Registry:
    """Figures and tables of the workflow; comments in workflow/results.yaml explain the keys of an entry.

    content : content of workflow/results.yaml, a mapping with the keys chapters, figures and tables

    Attributes
    ----------
    chapters : dict
        {chapter: category of the report}.
    figures : dict
        {figure: its entry}.
    table_rules : dict
        {rule that makes tables: its entry}. Some rules have a separate script; their entries name no function.
    """

    def __init__(self, content):
        self.chapters = content["chapters"]
        named = {name: {"file": name, "module": name} | entry for name, entry in content["figures"].items()}
        self.figures = {name: _FIGURE | entry for name, entry in named.items()}
        self.table_rules = {name: _RULE | entry for name, entry in content["tables"].items()}

    def tables(self, target):
        """Return the names of the tables that a target makes, except rule_costs, which is made last."""
        made = [entry["tables"] for entry in self.table_rules.values() if entry["target"] == target]
        return [name for tables in made for name in tables if name != "rule_costs"]

    def table_functions(self, rule):
        """Return dotted names of the function and of the column descriptions for a rule that makes tables.

        The key of the function is "tabulate". The keys of the column descriptions are the names of the tables.
        """
        entry = self.table_rules[rule]
        default = entry["function"].rpartition(".")[0] + ".COLUMNS"
        columns = {name: table.get("columns", default) for name, table in entry["tables"].items()}
        return {"tabulate": entry["function"]} | columns

    def figure_functions(self, figure):
        """Return dotted names of the function that draws a figure and of the functions that read its inputs.

        The key of the drawing function is "draw". The key of a reading function is the argument of the drawing function
        to which it belongs. Inputs that are tables need no such function.
        """
        entry = self.figures[figure]
        readers = [argument for argument, path in entry["input"].items() if not path.endswith(".csv")]
        draw = {"draw": "viscorough_study.figures.{module}.plot_{module}".format(**entry)}
        return draw | {argument: f"viscorough_study.figures.inputs.{argument}" for argument in readers}
