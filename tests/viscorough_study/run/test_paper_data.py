"""The paper's data: every number has its place, and the settings at the paper's scale are its numbers."""

import yaml

from support.study import CLAIMS, NUMBERS, ROOT
from viscorough_study.run.paper_data import read_paper


def test_every_number_has_its_place():
    for section in NUMBERS.values():
        for entry in section.values():
            assert {"value", "where"} <= set(entry)


def test_numbers_and_claims_agree():
    elements = NUMBERS["boundary_elements"]["elements"]["value"]
    assert elements == 51432
    assert str(elements) in CLAIMS["elements"]["statement"]
    assert f"{NUMBERS['agreement']['beta_hurst_min']['value']:g}" in CLAIMS["beta"]["statement"]


def test_every_sentence_is_judged_by_claims_or_says_why_not():
    sentences = read_paper(ROOT / "resources/paper", "sentences")
    assert {sentence["origin"] for sentence in sentences} == {"own", "quoted", "background"}
    for sentence in sentences:
        assert bool(sentence["claims"]) != bool(sentence.get("why")), sentence["says"]
        assert set(sentence["claims"]) <= {name for name, claim in CLAIMS.items() if claim["kind"] != "beyond"}
    judged = {name for sentence in sentences for name in sentence["claims"]}
    assert judged == {name for name, claim in CLAIMS.items() if claim["kind"] != "beyond"}


def test_settings_of_the_paper_are_its_numbers():
    default, paper = (yaml.safe_load((ROOT / f"config/{name}.yaml").read_text()) for name in ("config", "paper"))
    numbers = {name: entry["value"] for name, entry in NUMBERS["boundary_elements"].items()}
    assert default["discs"]["elements"] == numbers["elements_across"]
    assert default["discs"]["hurst"] == numbers["hurst_exponents"]
    assert len(default["discs"]["combinations"]) == numbers["combinations_per_hurst"]
    assert paper["discs"]["realizations"] >= numbers["realizations_min"]
    assert paper["lines"]["points"] == NUMBERS["reduction"]["points"]["value"]
    assert len(paper["lines"]["hurst"]) == NUMBERS["reduction"]["hurst_count"]["value"]
