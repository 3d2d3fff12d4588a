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
        """Return {key: dotted name} of the function and the column descriptions for a rule that makes tables.

        The key "tabulate" has the function that makes the tables. Each other key is the name of a table, and has the
        description of the columns of this table.
        """
        entry = self.table_rules[rule]
        default = entry["function"].rpartition(".")[0] + ".COLUMNS"
        columns = {name: table.get("columns", default) for name, table in entry["tables"].items()}
        return {"tabulate": entry["function"]} | columns

    def figure_functions(self, figure):
        """Return {key: dotted name} of the functions that make a figure.

        The key "draw" has the function that draws the figure. Each other key is an argument of this drawing function,
        and has the function that reads the input file for the argument. Input files with tables need no such function.
        """
        entry = self.figures[figure]
        readers = [argument for argument, path in entry["input"].items() if not path.endswith(".csv")]
        draw = {"draw": "viscorough_study.figures.{module}.plot_{module}".format(**entry)}
        return draw | {argument: f"viscorough_study.figures.inputs.{argument}" for argument in readers}
