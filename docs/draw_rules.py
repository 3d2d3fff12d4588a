"""Draw the rules of the workflow by stages, from Snakemake's own graph: python docs/draw_rules.py

The picture is docs/rules.png. It holds the edges that it was drawn from, as text under `SOURCE`.
"""

import re
import subprocess
import sys
import tempfile
from itertools import pairwise
from pathlib import Path

import yaml
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path as Curve

ROOT = Path(__file__).resolve().parents[1]
PICTURE, SOURCE = ROOT / "docs/rules.png", "Description"
# [(stage, what names of its rules begin with, colour)] from left to right
STAGES = [
    ("surface generation", ("generate_", "prepare_"), "#cfe3f5"),
    ("indentation", ("indent_", "reduce_"), "#c5e8d5"),
    ("aggregation", ("aggregate_",), "#f9e2a8"),
    ("fits and measurements", (), "#f6d3bd"),  # all others that need none of their kind
    ("comparisons and verdicts", (), "#f6d3bd"),  # all others
    ("figures", ("plot_",), "#e6d2ea"),
    ("page and costs, of all", ("make_", "show_", "tabulate_rule_costs"), "#e4e4e4"),
]
FITS = 3  # position of the first stage without names
LINE = {"color": "0.6", "linewidth": 0.9}
OF_ALL = ("show_tables", "tabulate_rule_costs")  # need nearly every rule


def rule_graph():
    """{(rule, rule that needs it)} of everything that `all` makes, with a measured surface."""
    with tempfile.TemporaryDirectory() as folder:
        settings = Path(folder) / "measured.yaml"
        settings.write_text(yaml.safe_dump({"measured": [{"name": "scan", "files": [__file__]}]}))
        command = [sys.executable, "-m", "snakemake", "--configfile", settings, "--directory", folder, "--rulegraph"]
        graph = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    names = dict(re.findall(r'(\d+)\[label = "(\w+)"', graph))
    edges = {(names[rule], names[then]) for rule, then in re.findall(r"(\d+) -> (\d+)", graph)}
    return {(rule, then) for rule, then in edges if then not in ("all", "measured")}


def stages(edges):
    """{rule: position of its stage}."""
    stage = {}
    for rule in sorted({name for edge in edges for name in edge}):
        named = [i for i, (_, beginnings, _) in enumerate(STAGES) if rule.startswith(beginnings)]
        stage[rule] = named[0] if named else FITS
    of_fits = {rule for rule, position in stage.items() if position == FITS}
    return stage | {then: FITS + 1 for rule, then in edges if {rule, then} <= of_fits}


def without_implied(edges):
    """The edges that do not follow from others, without those of rules that need nearly every rule."""
    edges = {(rule, then) for rule, then in edges if not then.startswith(OF_ALL)}
    after = {rule: {then for one, then in edges if one == rule} for rule, _ in edges}

    def reached(rule):
        return after.get(rule, set()).union(*(reached(then) for then in after.get(rule, ())))

    return {(rule, then) for rule, then in edges if not any(then in reached(between) for between in after[rule])}


def from_stage_to_stage(edges, stage):
    """Edges and {rule: position} with places where longer edges pass a stage, named "rule position"."""
    short, passed = set(), {}
    for rule, then in edges:
        between = {f"{rule} {position}": position for position in range(stage[rule] + 1, stage[then])}
        short |= set(pairwise([rule, *between, then]))
        passed |= between
    return short, stage | dict(sorted(passed.items()))


def rows(edges, stage):
    """{rule: row}, near those of its neighbours; rules of a stage are at least a row apart."""
    row = {rule: float(i) for i, rule in enumerate(stage)}
    for _ in range(100):
        for position in range(len(STAGES)):
            wanted = {}
            for rule in (rule for rule in stage if stage[rule] == position):
                near = [row[edge[rule == edge[0]]] for edge in edges if rule in edge] or row.values()
                wanted[rule] = sum(near) / len(near)
            row |= spread(wanted)
    return row


def spread(wanted):
    """The rows wanted, moved apart to distances of at least one; in clusters, whose mean stays where it is."""
    clusters = []
    for rule in sorted(wanted, key=wanted.get):
        clusters.append(([rule], wanted[rule]))
        while len(clusters) > 1 and overlap(*clusters[-2:]):
            (below, low), (above, high) = clusters.pop(-2), clusters.pop()
            middle = (len(below) * low + len(above) * high) / (len(below) + len(above))
            clusters.append((below + above, middle))
    return {rule: mid + i - (len(rules) - 1) / 2 for rules, mid in clusters for i, rule in enumerate(rules)}


def overlap(below, above):
    return above[1] - below[1] < (len(below[0]) + len(above[0])) / 2


def draw(edges, path):
    """A column for each stage, a box for each rule, and a line for each edge that others do not imply."""
    shown, stage = from_stage_to_stage(without_implied(edges), stages(edges))
    row = rows(shown, stage)
    top, bottom = min(row.values()) - 2, max(row.values()) + 1
    figure = Figure(figsize=(14, 0.22 * (bottom - top)))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(-0.5, len(STAGES) - 0.5), ylim=(bottom, top))
    axes.axis("off")
    for rule, then in sorted(shown):
        curve = Curve(bezier(stage, row, rule, then), [Curve.MOVETO] + 3 * [Curve.CURVE4])
        axes.add_patch(PathPatch(curve, fill=False, **LINE))
    for position, (name, _, colour) in enumerate(STAGES):
        axes.text(position, top + 0.7, name, ha="center", va="center", fontsize=9.5, fontweight="bold")
        for rule in (rule for rule in stage if stage[rule] == position):
            if " " in rule:
                axes.plot([position - 0.42, position + 0.42], [row[rule]] * 2, **LINE)
                continue
            look = {"facecolor": colour, "edgecolor": "0.4", "linewidth": 0.6}
            axes.add_patch(Rectangle((position - 0.42, row[rule] - 0.36), 0.84, 0.72, **look))
            axes.text(position, row[rule], rule, ha="center", va="center", fontsize=8)
    text = "\n".join(f"{rule} -> {then}" for rule, then in sorted(edges))
    figure.savefig(path, dpi=130, metadata={SOURCE: text, "Software": None})


def bezier(stage, row, rule, then):
    """Four points of the curve from one box to another."""
    if stage[rule] == stage[then]:  # around the left ends
        left = stage[rule] - 0.42
        return (left, row[rule]), (left - 0.12, row[rule]), (left - 0.12, row[then]), (left, row[then])
    start, end = stage[rule] + 0.42, stage[then] - 0.42
    middle = (start + end) / 2
    return (start, row[rule]), (middle, row[rule]), (middle, row[then]), (end, row[then])


if __name__ == "__main__":
    draw(rule_graph(), PICTURE)
