"""The paper's data: every number states its place in the paper, and the settings of the full scale agree with them."""

import yaml

from support.study import NUMBERS, ROOT


def test_settings_of_the_paper_agree_with_its_numbers():
    default, paper = (yaml.safe_load((ROOT / f"config/{name}.yaml").read_text()) for name in ("config", "paper"))
    numbers = {name: entry["value"] for name, entry in NUMBERS["boundary_elements"].items()}
    assert default["discs"]["elements"] == numbers["elements_across"]
    assert default["hurst"] == numbers["hurst_exponents"]
    assert len(default["discs"]["combinations"]) == numbers["combinations_per_hurst"]
    assert paper["discs"]["realizations"] >= numbers["realizations_min"]
    assert paper["lines"]["points"] == NUMBERS["reduction"]["points"]["value"]
    assert 1 + round(1 / paper["lines"]["hurst_step"]) == NUMBERS["reduction"]["hurst_count"]["value"]
