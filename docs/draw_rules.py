"""Draw the rules of the workflow by stages, from Snakemake's own graph: python docs/draw_rules.py

The picture is docs/rules.png. It contains its edges as text under `SOURCE`.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import yaml
from matplotlib.figure import Figure

ROOT = Path(__file__).resolve().parents[1]
PICTURE, SOURCE = ROOT / "docs/rules.png", "Description"
# {stage: (names of its rules, or their beginnings; colour)} from left to right
STAGES = {
    "surface generation": (("generate_", "prepare_"), "#cfe3f5"),
    "indentation": (("indent_", "reduce_"), "#c5e8d5"),
    "aggregation": (("aggregate_",), "#f9e2a8"),
    "fits and measurements": ((), "#f6d3bd"),  # all other rules that depend on no rule of their stage
    "comparisons and verdicts": ((), "#f6d3bd"),  # all other rules
    "figures": (("plot_",), "#e6d2ea"),
    "page": (("make_",), "#e4e4e4"),
}
FITS = list(STAGES).index("fits and measurements")


def rule_graph():
    """Return {(rule, rule that needs it)} of everything that `all` makes, with a measured surface."""
    with tempfile.TemporaryDirectory() as folder:
        settings = Path(folder) / "measured.yaml"
        settings.write_text(yaml.safe_dump({"measured": [{"name": "scan", "files": [__file__]}]}))
        command = [sys.executable, "-m", "snakemake", "--configfile", settings, "--directory", folder, "--rulegraph"]
        graph = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    names = dict(re.findall(r'(\d+)\[label = "(\w+)"', graph))
    edges = {(names[rule], names[then]) for rule, then in re.findall(r"(\d+) -> (\d+)", graph)}
    return {(rule, then) for rule, then in edges if then not in ("all", "measured")}


def columns(edges):
    """Return {rule: position of its stage}."""
    column = {}
    for rule in sorted({name for edge in edges for name in edge}):
        named = [i for i, (beginnings, _) in enumerate(STAGES.values()) if rule.startswith(beginnings)]
        column[rule] = named[0] if named else FITS
    of_fits = {rule for rule, position in column.items() if position == FITS}
    return column | {then: FITS + 1 for rule, then in edges if {rule, then} <= of_fits}


def without_implied(edges):
    """Return the edges that do not follow from others."""

    def reached(rule):
        following = {then for before, then in edges if before == rule}
        return following.union(*map(reached, following))

    return {(rule, then) for rule, then in edges if not any(then in reached(b) for a, b in edges if a == rule)}


def draw(edges, path):
    """Draw a column for each stage, a box for each rule, and a line for each edge that does not follow from others.

    The rules of a column are evenly spaced, in the order of the rules that they need; rules without needs are last.
    """
    shown, column, row = sorted(without_implied(edges)), columns(edges), {}
    bottom = max(map(list(column.values()).count, column.values()))
    figure = Figure(figsize=(14, 0.25 * bottom))
    axes = figure.add_axes((0, 0, 1, 1), xlim=(-0.5, len(STAGES) - 0.5), ylim=(bottom, -1))
    axes.axis("off")
    for position, (stage, (_, colour)) in enumerate(STAGES.items()):
        axes.text(position, -0.3, stage, ha="center", fontsize=9.5, fontweight="bold")
        rules = [rule for rule in column if column[rule] == position]
        needed = {then: [row[rule] for rule, later in shown if later == then and rule in row] for then in rules}
        farthest = {rule: max((column[then] for before, then in shown if before == rule), default=0) for rule in rules}
        rules.sort(key=lambda rule: (np.mean(needed[rule] or np.inf), farthest[rule]))
        row |= {rule: (i + 0.5) / len(rules) * bottom for i, rule in enumerate(rules)}
        for rule in rules:
            axes.barh(row[rule], 0.84, 0.72, position - 0.42, color=colour, edgecolor="0.4", linewidth=0.6, zorder=3)
            axes.text(position, row[rule], rule, ha="center", va="center", fontsize=8, zorder=4)
    for rule, then in shown:
        line = (column[rule] + 0.42, column[then] - 0.42), (row[rule], row[then])
        axes.plot(*line, color="0.6", linewidth=0.9)
    text = "\n".join(f"{rule} -> {then}" for rule, then in sorted(edges))
    figure.savefig(path, dpi=130, metadata={SOURCE: text, "Software": None})


if __name__ == "__main__":
    draw(rule_graph(), PICTURE)
