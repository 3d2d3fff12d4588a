"""The check of the settings, and the settings of every scale."""

import re

import numpy as np
import pandas as pd
import pytest
import yaml

from support.workflow import ROOT, merged, read_settings
from viscorough_study.settings import SettingsError, check_settings

SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())


@pytest.fixture
def settings():
    return read_settings("config")


TASK = {"name": "few", "elements": 33, "levels": 8, "fractions": [0.01, 0.5], "residual": 1e-6, "threads": [1]}
COMBINATION = {"number": 1, "force": 1.0, "viscosity": 1.0, "diameter": 1.0, "rms": 1e-3}
WRONG = [
    ({"discs": {"elemnts": 33}}, "unknown key elemnts in discs; did you mean elements?"),
    ({"colour": "blue"}, "unknown key colour; allowed: collapse, direct, discs"),
    ({"discs": {"elements": "many"}}, "discs.elements is 'many'; allowed: a whole number from 9 up to 4097"),
    ({"discs": {"elements": 33.0}}, "discs.elements is 33.0; allowed: a whole number"),
    ({"discs": {"realizations": True}}, "discs.realizations is True; allowed: a whole number"),
    (
        {"discs": {"hurst": [0.4, 1.2]}},
        "discs.hurst[1] is 1.2; allowed: a number from 0 up to 1 of at most 4 decimals (Hurst",
    ),
    ({"discs": {"hurst": []}}, "discs.hurst is []; allowed: a list of at least 1"),
    ({"discs": None}, "discs is empty; allowed: keys with values"),
    ({"discs": [1, 2]}, "discs is [1, 2]; allowed: keys with values"),
    ({"indentation": {"tolerance": "1e-3"}}, "write numbers as 1.0e-3, with a point"),
    ({"indentation": {"until_x": float("nan")}}, "indentation.until_x is nan; allowed: a number from 1e-14"),
    ({"indentation": {"until_x": 1e-300}}, "indentation.until_x is 1e-300; allowed: a number from 1e-14"),
    ({"indentation": {"until_fraction": 1e-300}}, "indentation.until_fraction is 1e-300; allowed: a number from 1e-06"),
    ({"sizes": {"until_x": 1e-300}}, "sizes.until_x is 1e-300; allowed: a number from 1e-14"),
    ({"large": {"until_fraction": 1e-300}}, "large.until_fraction is 1e-300; allowed: a number from 1e-06"),
    (
        {"indentation": {"until_x": 1e-9}},
        "ensemble.x_low and indentation.until_x: 1e-09 and 1e-09 are less than a decade",
    ),
    ({"sizes": {"until_x": 1e-12}}, "ensemble.x_low and sizes.until_x: 1e-09 and 1e-12 are less than a decade"),
    ({"surface": {"amplitudes": "constant"}}, "surface.amplitudes is 'constant'; allowed: one of random, fixed"),
    ({"surface": {"corners": 1}}, "surface.corners is 1; allowed: true or false"),
    ({"seed": -1}, "seed is -1; allowed: a whole number from 0"),
    ({"discs": {"combinations": [{"number": 1, "force": 1.0}]}}, "viscosity in discs.combinations[0] is missing"),
    (
        {"variants": {"cases": [{"name": "nothing"}]}},
        "variants.cases[0] is {'name': 'nothing'}; allowed: keys with values",
    ),
    ({"variants": {"cases": [{"name": "Bad 1", "period": 2.0}]}}, "variants.cases[0].name is 'Bad 1'; allowed: text"),
    (
        {"variants": {"cases": [{"name": "sizes", "period": 2.0}]}},
        "variants.cases[0].name is 'sizes'; allowed: text (its name in file names",
    ),
    (
        {"variants": {"cases": [{"name": "wider\n", "period": 2.0}]}},
        r"variants.cases[0].name is 'wider\n'; allowed",
    ),
    ({"methods": {"tasks": [TASK | {"name": "few\n"}]}}, r"methods.tasks[0].name is 'few\n'; allowed: text"),
    ({"methods": {"tasks": [TASK | {"fractions": [0.5, 0.5]}]}}, "fractions of few in methods.tasks are too close"),
    ({"dis\ncs": 1}, r"unknown key 'dis\ncs'; did you mean discs?"),
    ({"discs": {"combinations": [COMBINATION | {"rms": 1e-200}]}}, "rms is 1e-200; allowed: a number from 1e-12"),
    ({"discs": {"combinations": [COMBINATION | {"diameter": 10.0, "rms": 1e-12}]}}, "rms 1e-12 in combination 1"),
    (
        {"media": {"cases": [{"name": "fluid", "kind": "maxwell", "viscosity": 1.0}]}},
        "fluid in media.cases: lacks shear_modulus; maxwell needs shear_modulus, viscosity",
    ),
    (
        {"media": {"cases": [{"name": "fluid", "kind": "newtonian", "viscosity": 1.0, "exponent": 0.5}]}},
        "fluid in media.cases: unknown key 'exponent'; allowed for newtonian: viscosity",
    ),
    (
        {"media": {"cases": [{"name": "fluid", "kind": "honey"}]}},
        "media.cases[0].kind is 'honey'; allowed: one of newt",
    ),
    ({"media": {"times": {"low": 1.0, "high": 2.0}}}, "media.times.low and high: 1.0 and 2.0 are less than a decade"),
    ({"measured": [{"name": "mine", "files": []}]}, "measured[0].files is []; allowed: a list of at least 1"),
    (
        {"measured": [{"name": "mine", "files": ["a.npy"], "preparation": {"detrend": "cubic"}}]},
        "measured[0].preparation.detrend is 'cubic'; allowed: one of none, mean, plane, sphere",
    ),
    (
        {"lines": {"hurst": [0.4, 0.40000000001]}},
        "lines.hurst[1] is 0.40000000001; allowed: a number from 0 up to 1 of at most 4 decimals",
    ),
    ({"discs": {"hurst": [0.4, 0.4]}}, "discs.hurst: 0.4 occurs twice; allowed: once"),
    (
        {"sizes": {"discs": [{"elements": 17, "realizations": 2}]}},
        "roll_off_wavelength 0.125 of sizes.control is too short",
    ),
    ({"sizes": {"lines": 2 * [{"points": 64, "realizations": 2}]}}, "points in sizes.lines: 64 occurs twice"),
    ({"discs": {"hurst": [0.4, 0.33]}}, "discs.hurst has 0.33, lines.hurst has not"),
    (
        {"lines": {"hurst": [0.12345]}},
        "lines.hurst[0] is 0.12345; allowed: a number from 0 up to 1 of at most 4 decimals",
    ),
    ({"ensemble": {"x_low": 40.0}}, "ensemble.x_low and x_high: 40.0 and 30.0 are less than a decade"),
    ({"sizes": {"windows": [[0.01, 0.02]]}}, "sizes.windows[0]: 0.01 and 0.02 are less than a decade"),
    ({"reduction": {"x_low": 3.0}}, "reduction.x_low is 3.0; allowed: a number from 1e-15 up to 0.1"),
    ({"reduction": {"x_low": 0.1, "x_high": 0.1000001}}, "0.1 and 0.1000001 are less than a decade"),
    ({"methods": {"groups": ["path", "paths"]}}, "methods.groups[1] is 'paths'; allowed: one of path, path without"),
    ({"methods": {"groups": ["path", "path"]}}, "methods.groups: path occurs twice; allowed: once"),
    ({"scaling": {"stiffness_range": [0.3, 0.03]}}, "scaling.stiffness_range: 0.3 and 0.03 are no range"),
    ({"surface": {"roll_off_wavelength": 0.001}}, "roll_off_wavelength 0.001 of surface is too short"),
]


@pytest.mark.parametrize(("wrong", "message"), WRONG, ids=[message[:30] for _, message in WRONG])
def test_wrong_settings_end_with_one_line(settings, wrong, message):
    with pytest.raises(SettingsError) as error:
        check_settings(merged(settings, wrong), SCHEMA)
    text = str(error.value)
    assert message in text
    assert "\n" not in text
    assert len(text) < 250


def test_twice_the_same_combination(settings):
    settings["discs"]["combinations"][1]["number"] = 1
    with pytest.raises(SettingsError, match=r"number in discs.combinations: 1 occurs twice"):
        check_settings(settings, SCHEMA)


def test_too_rough_a_combination(settings):
    settings["discs"]["combinations"][0]["rms"] = 1e-3
    with pytest.raises(SettingsError, match=r"rms 0.001 in combination 1 .* allowed: below diameter/100"):
        check_settings(settings, SCHEMA)


@pytest.mark.parametrize("name", ["config", "paper", "sizes", "methods", "test"])
def test_settings_of_every_scale_are_right(name):
    check_settings(merged(read_settings("config"), read_settings(name)), SCHEMA)


@pytest.mark.parametrize("name", ["paper", "sizes", "methods", "test"])
def test_other_scales_hold_only_what_differs(settings, name):
    def same(base, extra, path=""):
        for key, value in extra.items():
            if isinstance(value, dict):
                yield from same(base[key], value, f"{path}{key}.")
            elif value == base[key]:
                yield path + key

    assert list(same(settings, read_settings(name))) == []


def test_paper_is_the_scale_of_the_paper():
    paper = merged(read_settings("config"), read_settings("paper"))
    assert paper["discs"]["hurst"] == [0.1, 0.4, 0.6, 0.9]
    assert paper["discs"]["elements"] == 257
    assert len(paper["discs"]["hurst"]) * len(paper["discs"]["combinations"]) == 36
    assert paper["discs"]["realizations"] == 2 * 80  # the paper has at least 80
    np.testing.assert_allclose(paper["lines"]["hurst"], np.linspace(0, 1, 101), atol=1e-12)
    assert (paper["lines"]["realizations"], paper["lines"]["points"]) == (500, 4_000_000)


def test_combinations_span_decades(settings):
    combinations = pd.DataFrame(settings["discs"]["combinations"])
    assert len(combinations) == 9
    quantities = np.log10(combinations[["force", "viscosity", "diameter", "rms"]])
    assert (quantities.max() - quantities.min() >= 2).all()
    assert np.linalg.matrix_rank(quantities - quantities.mean()) == 4  # none is a power of the others
    assert (combinations["rms"] / combinations["diameter"] <= 1e-4).all()


def leaves(rule, definitions, path=""):
    """(key, schema) of every setting, lists of mappings as key[]."""
    if "$ref" in rule:
        rule = definitions[rule["$ref"].split("/")[-1]]
    if path:
        yield path, rule
    for name, inner in rule.get("properties", {}).items():
        yield from leaves(inner, definitions, f"{path}.{name}".lstrip("."))
    if rule.get("items", {}).get("type") == "object":
        yield from leaves(rule["items"], definitions, f"{path}[]")


@pytest.fixture(scope="session")
def schema():
    return dict(leaves(SCHEMA, SCHEMA["$defs"]))


def test_schema_describes_every_key(schema):
    assert len(schema) > 50
    for key, rule in schema.items():
        assert rule["description"], key
        if "properties" in rule:
            assert rule["additionalProperties"] is False, key
        elif rule.get("type") == "array":
            assert "maxItems" in rule, key
        else:
            assert rule["unit"], key
            limited = {"enum", "pattern"} & set(rule) or rule["type"] == "boolean"
            assert limited or ({"maximum"} < {*rule} and {"minimum", "exclusiveMinimum"} & set(rule)), key


def test_readme_explains_every_key(schema):
    text = (ROOT / "config/README.md").read_text().split("## Keys")[1]
    explained = re.findall(r"^\| `(.+?)` \|", text, re.MULTILINE)
    wanted = {key for key, rule in schema.items() if "properties" not in rule}
    assert set(explained) == wanted
    assert len(explained) == len(wanted)
