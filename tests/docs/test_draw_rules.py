"""The picture of the rules."""

import draw_rules
import pytest
from PIL import Image


@pytest.mark.long
def test_picture_has_the_rules_of_the_workflow():
    """The picture was drawn from the edges that Snakemake reports now."""
    with Image.open(draw_rules.PICTURE) as picture:
        drawn = {tuple(line.split(" -> ")) for line in picture.text[draw_rules.SOURCE].splitlines()}
    assert drawn == draw_rules.rule_graph(), "run python docs/draw_rules.py"
