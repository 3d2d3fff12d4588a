"""The check of the settings, and the settings of every scale."""

import re

import pytest
import yaml

from support.workflow import ROOT, merged, read_settings
from viscorough_study.figures.conventions import CONVENTION_LABELS
from viscorough_study.fits.conventions import VALUES
from viscorough_study.run.settings import check_settings

SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())

COMBINATION = {"number": 1, "force": 1.0, "viscosity": 1.0, "diameter": 1.0, "rms": 1e-3}
SCAN = {"name": "scan", "files": ["z.npy"]}
FLUID = {"name": "fluid", "kind": "newtonian", "viscosity": 1.0}
WRONG = [
    ({"discs": {"elemnts": 33}}, "unknown key 'elemnts' in discs; did you mean elements?"),
    ({"colour": "blue"}, "unknown key 'colour' in settings; allowed: article, collapse, direct, discs"),
    ({"dis\ncs": 1}, r"unknown key 'dis\ncs' in settings; did you mean discs?"),
    ({"discs": {"elements": "many"}}, "discs.elements is 'many'; allowed: type integer, minimum 9, maximum 4097"),
    ({"discs": {"elements": 33.0}}, "discs.elements is 33.0; allowed: type integer"),
    ({"discs": {"realizations": True}}, "discs.realizations is True; allowed: type integer"),
    ({"discs": {"hurst": [0.4, 1.2]}}, "discs.hurst[1] is 1.2; allowed: type number, minimum 0, maximum 1, decimals"),
    ({"discs": {"hurst": []}}, "discs.hurst is []; allowed: type array, minItems 1"),
    ({"discs": None}, "discs is empty; allowed: type object ("),
    ({"indentation": {"tolerance": "1e-3"}}, "write numbers as 1.0e-3, with a point"),
    ({"indentation": {"until_x": float("nan")}}, "indentation.until_x is nan; allowed: type number, minimum 1e-14"),
    ({"indentation": {"until_x": 1e-9}}, "ensemble.x_low and indentation.until_x: 1e-09 and 1e-09 are too close"),
    ({"surface": {"amplitudes": "constant"}}, "surface.amplitudes is 'constant'; allowed: enum ['random', 'fixed'] ("),
    ({"surface": {"corners": 1}}, "surface.corners is 1; allowed: type boolean ("),
    ({"discs": {"combinations": [{"number": 1, "force": 1.0}]}}, "discs.combinations[0]: 'viscosity' is a required"),
    ({"discs": {"combinations": 2 * [COMBINATION]}}, "discs.combinations: number 1 occurs twice"),
    ({"discs": {"combinations": [COMBINATION | {"rms": 0.1}]}}, "rms 0.1 in combination 1 of discs.combinations is"),
    ({"discs": {"combinations": [COMBINATION | {"diameter": 10.0, "rms": 1e-12}]}}, "rms 1e-12 in combination 1"),
    ({"variants": {"cases": [{"name": "nothing"}]}}, "variants.cases[0] is {'name': 'nothing'}; allowed: type"),
    ({"variants": {"cases": [{"name": "sizes", "period": 2.0}]}}, "variants.cases[0].name is 'sizes'; allowed"),
    ({"variants": {"cases": [{"name": "wider\n", "period": 2.0}]}}, r"variants.cases[0].name is 'wider\n'; allowed"),
    ({"methods": {"tasks": []}}, "unknown key 'tasks' in methods; allowed: bodies, bodies_elements, elements"),
    ({"methods": {"elements": [33, 33]}}, "methods.elements: 33 occurs twice; allowed: once"),
    ({"media": {"cases": [FLUID | {"kind": "maxwell"}]}}, "fluid in media.cases: lacks shear_modulus; maxwell needs"),
    ({"media": {"cases": [FLUID | {"exponent": 0.5}]}}, "fluid in media.cases: unknown key 'exponent'; allowed for"),
    ({"lines": {"hurst": [0.4, 0.40000000001]}}, "lines.hurst[1] is 0.40000000001; allowed: type number"),
    ({"sizes": {"discs": [{"elements": 17, "realizations": 2}]}}, "roll_off_wavelength 0.125 of sizes.control is too"),
    ({"discs": {"hurst": [0.4, 0.33]}}, "discs.hurst has 0.33, lines.hurst has not"),
    ({"discs": {"short_until_x": 0.5}}, "discs.short_until_x: curves that end at X = 0.5 miss a part of verdicts"),
    ({"sizes": {"windows": [[0.01, 0.02]]}}, "sizes.windows[0]: 0.01 and 0.02 are too close"),
    ({"scaling": {"stiffness_range": [0.3, 0.03]}}, "scaling.stiffness_range: 0.3 and 0.03 are in the wrong order"),
    ({"verdicts": {"plateau_range": [1, 1e-3]}}, "verdicts.plateau_range: 1 and 0.001 are in the wrong order; allowed"),
    (
        {"verdicts": {"plateau_range": [1e-3, 100]}},
        "verdicts.plateau_range[1] and ensemble.x_high: 100 and 30.0 are in",
    ),
    ({"ensemble": {"x_low": 1e-2}}, "ensemble.x_low and verdicts.plateau_range[0]: 0.01 and 0.001 are in the wrong"),
    ({"periodic": {"x_low": 10, "x_high": 0.1}}, "periodic.x_low and x_high: 10 and 0.1 are in the wrong order"),
    ({"periodic": {"hurst": [0.1, 0.1]}}, "periodic.hurst: 0.1 occurs twice; allowed: once"),
    ({"lines": {"hurst": [0, 0.0, 0.1, 0.4, 0.6, 0.9]}}, "lines.hurst: 0 occurs twice; allowed: once"),
    ({"sizes": {"windows": [[1e-3, 1e-2], [1e-3, 1e-2]]}}, "sizes.windows: [0.001, 0.01] occurs twice; allowed: once"),
    ({"collapse": {"x_high": [0.1, 1e-10]}}, "ensemble.x_low and collapse.x_high[1]: 1e-09 and 1e-10 are in the wrong"),
    ({"collapse": {"elements_min": [10, 10]}}, "collapse.elements_min: 10 occurs twice; allowed: once"),
    (
        {"scaling": {"slope_half_width": 0.01}},
        "scaling.slope_half_width: 0.01 decades hold no further abscissa; allowed",
    ),
    ({"measured": [SCAN | {"forces": [1, 1.0]}]}, "measured[0].forces: 1 occurs twice; allowed: once"),
    ({"measured": [SCAN | {"preparation": {"crop": [[0, 9], [5, 5]]}}]}, "measured[0].preparation.crop[1]: 5 to 5 is"),
]


@pytest.mark.parametrize(("wrong", "message"), WRONG, ids=[message[:30] for _, message in WRONG])
def test_wrong_settings_end_with_one_line(wrong, message):
    with pytest.raises(ValueError, match=re.escape(message)) as error:
        check_settings(merged(read_settings("config"), wrong), SCHEMA)
    assert "\n" not in str(error.value)
    assert len(str(error.value)) < 250


@pytest.mark.parametrize(
    ("change", "names"),
    [
        ({"discs": {"elements": "many"}}, "mine.yaml"),
        ({"discs": {"elemnts": 33}}, "mine.yaml"),
        ({"discs": {"combinations": 2 * [COMBINATION]}}, "mine.yaml"),
        ({"discs": {"hurst": [0.33]}}, "mine.yaml and other.yaml"),
        ({"periodic": {"x_high": 0.1}}, "config.yaml and mine.yaml"),
        ({"discs": {"elements": 65, "combinations": []}}, "mine.yaml"),
        ({"discs": {"elements": 66}, "reduction": {"x_high": 1e-15}}, "config.yaml and mine.yaml"),
    ],
)
def test_file_of_a_wrong_setting_is_named(change, names):
    """If several files give a setting, the error names the last; if settings contradict each other, all their files."""
    default, other = read_settings("config"), {"lines": {"hurst": [0.1, 0.4, 0.6, 0.9]}, "discs": {"elements": 65}}
    sources = {"config.yaml": default, "other.yaml": other, "mine.yaml": change}
    with pytest.raises(ValueError, match=f"^{names}: "):
        check_settings(merged(merged(default, other), change), SCHEMA, sources)


@pytest.mark.parametrize("name", ["config", "paper", "sizes", "methods", "test"])
def test_settings_of_every_scale_are_valid(name):
    check_settings(merged(read_settings("config"), read_settings(name)), SCHEMA)


def test_settings_and_figures_have_the_same_conventions():
    figures = SCHEMA["properties"]["figures"]["properties"]
    for name, values in VALUES.items():
        assert sorted(figures[name]["enum"]) == sorted(CONVENTION_LABELS[name]) == sorted(values)


def leaves(rule, definitions, path=""):
    """Yield (key, schema) of every setting; lists of mappings have the key `key[]`."""
    if "$ref" in rule:
        rule = definitions[rule["$ref"].split("/")[-1]]
    if path:
        yield path, rule
    for name, inner in rule.get("properties", {}).items():
        yield from leaves(inner, definitions, f"{path}.{name}".lstrip("."))
    if rule.get("items", {}).get("type") == "object":
        yield from leaves(rule["items"], definitions, f"{path}[]")


KEYS = dict(leaves(SCHEMA, SCHEMA["$defs"]))


def test_schema_describes_every_key():
    assert len(KEYS) > 50
    for key, rule in KEYS.items():
        assert rule["description"], key
        if "properties" in rule:
            assert rule["additionalProperties"] is False, key
        elif rule.get("type") == "array":
            assert "maxItems" in rule, key
        else:
            assert rule["unit"], key
            limited = {"enum", "pattern"} & set(rule) or rule["type"] == "boolean"
            assert limited or ({"maximum"} < {*rule} and {"minimum", "exclusiveMinimum"} & set(rule)), key


def test_readme_explains_every_key():
    text = (ROOT / "config/README.md").read_text().split("## Keys")[1]
    explained = re.findall(r"^\| `(.+?)` \|", text, re.MULTILINE)
    wanted = {key for key, rule in KEYS.items() if "properties" not in rule}
    assert set(explained) == wanted
    assert len(explained) == len(wanted)
