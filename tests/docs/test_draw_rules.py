"""The picture of the rules."""

import draw_rules
import pytest
from PIL import Image


def test_picture_has_the_rules_of_the_workflow():
    """The edges that it was drawn from are those that Snakemake tells now."""
    with Image.open(draw_rules.PICTURE) as picture:
        drawn = {tuple(line.split(" -> ")) for line in picture.text[draw_rules.SOURCE].splitlines()}
    assert drawn == draw_rules.rule_graph(), "run python docs/draw_rules.py"


CHAIN = {("generate_discs", "indent_surfaces"), ("indent_surfaces", "aggregate_curves")}
CHAIN |= {("aggregate_curves", "fit_scaling"), ("fit_scaling", "plot_exponent")}
CHAIN |= {("fit_scaling", "tabulate_calibration")}


def test_rules_stand_in_their_stages_apart_from_each_other():
    """And edges lead from left to right; those that follow from others are left out."""
    implied = {("aggregate_curves", "plot_exponent"), ("indent_surfaces", "show_tables_of_all")}
    assert draw_rules.without_implied(CHAIN | implied) == CHAIN
    edges, stage = draw_rules.from_stage_to_stage(CHAIN, draw_rules.stages(CHAIN))
    assert all(stage[then] == stage[rule] + 1 for rule, then in edges)
    stages = {"generate_discs": 0, "fit_scaling": 3, "tabulate_calibration": 4, "plot_exponent": 5}
    assert {rule: stage[rule] for rule in stages} == stages
    assert stage["fit_scaling 4"] == 4
    row = draw_rules.rows(edges, stage)
    assert abs(row["fit_scaling 4"] - row["tabulate_calibration"]) >= 1 - 1e-9
    assert abs(row["generate_discs"] - row["indent_surfaces"]) < 0.2


def test_a_crowded_stage_is_spread_about_its_middle():
    spread = draw_rules.spread({"a": 0.0, "b": 0.0, "c": 0.3, "d": 9.0})
    assert [spread[name] for name in "abcd"] == pytest.approx([-0.9, 0.1, 1.1, 9.0])
