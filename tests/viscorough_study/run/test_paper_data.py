"""The paper's data: every number states its place in the paper, and the settings of the full scale agree with them."""

import yaml

from support.study import NUMBERS, ROOT
from viscorough_study.run.paper_data import read_records


def test_every_number_states_its_place_in_the_paper():
    for section in NUMBERS.values():
        for entry in section.values():
            assert {"value", "where"} <= set(entry)


def test_settings_of_the_paper_agree_with_its_numbers():
    default, paper = (yaml.safe_load((ROOT / f"config/{name}.yaml").read_text()) for name in ("config", "paper"))
    numbers = {name: entry["value"] for name, entry in NUMBERS["boundary_elements"].items()}
    assert default["discs"]["elements"] == numbers["elements_across"]
    assert default["hurst"] == numbers["hurst_exponents"]
    assert len(default["discs"]["combinations"]) == numbers["combinations_per_hurst"]
    assert paper["discs"]["realizations"] >= numbers["realizations_min"]
    assert paper["lines"]["points"] == NUMBERS["reduction"]["points"]["value"]
    assert 1 + round(1 / paper["lines"]["hurst_step"]) == NUMBERS["reduction"]["hurst_count"]["value"]


def test_records_of_a_table_have_numbers_and_texts(tmp_path):
    (tmp_path / "table.csv").write_text(
        "solver,version,levels,seconds\nown,1.0.0,3,1.0e-3\nother,,4,\n", encoding="utf-8"
    )
    own, other = read_records(tmp_path / "table.csv")
    assert own == {"solver": "own", "version": "1.0.0", "levels": 3, "seconds": 1e-3}
    assert other == {"solver": "other", "version": None, "levels": 4, "seconds": None}
