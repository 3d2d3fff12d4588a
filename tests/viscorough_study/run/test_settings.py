"""The check of the settings, and the settings of every scale."""

import copy
import functools
import operator
import re
from pathlib import Path

import jsonschema
import pytest

from support.workflow import ROOT, merged, read_settings
from viscorough_study.run.settings import changed_settings, check_settings, complete_settings, resolved, schema

COMBINATION = {"number": 1, "force": 1.0, "viscosity": 1.0, "diameter": 1.0, "rms": 1e-3}
SCAN = {"name": "scan", "files": ["z.npy"]}
FLUID = {"name": "fluid", "kind": "newtonian", "viscosity": 1.0}


def nested(changed):
    """Return settings of two nested grids of which the finer grid has changed values."""
    coarse, fine = ({"elements": elements, "surfaces": 20, "until_x": 0.1, "batch": 20} for elements in (129, 257))
    return {"nested_grids": {"ensembles": [{"hurst": 0.4, "grids": [coarse, fine | changed]}]}}


WRONG = [
    ({"discs": {"elemnts": 33}}, "unknown key 'elemnts' in discs; did you mean elements?"),
    ({"colour": "blue"}, "unknown key 'colour' in settings; allowed: direct, discs, ensemble"),
    ({"dis\ncs": 1}, r"unknown key 'dis\ncs' in settings; did you mean discs?"),
    ({"discs": {"elements": "many"}}, "discs.elements is 'many'; allowed: integer, 9 to 4097 (elements across"),
    ({"discs": {"elements": 33.0}}, "discs.elements is 33.0; allowed: integer, 9 to"),
    ({"discs": {"realizations": True}}, "discs.realizations is True; allowed: integer, 2 to"),
    ({"discs": {"hurst": [0.4, 1.2]}}, "discs.hurst[1] is 1.2; allowed: 0 to 1, at most 4 decimals (Hurst"),
    ({"discs": {"hurst": []}}, "discs.hurst is []; allowed: 1 to 101 numbers, each 0 to 1"),
    ({"discs": None}, "discs is empty; allowed: a mapping (Self-affine discs"),
    ({"indentation": {"tolerance": "1e-3"}}, "write numbers as 1.0e-3, with a point"),
    ({"indentation": {"until_x": float("nan")}}, "indentation.until_x is nan; allowed: 1e-14 to 10000 ("),
    ({"indentation": {"until_x": 1e-9}}, "ensemble.x_low and indentation.until_x: 1e-09 and 1e-09 are too close"),
    ({"surface": {"amplitudes": "constant"}}, "surface.amplitudes is 'constant'; allowed: random, fixed ("),
    ({"surface": {"corners": 1}}, "surface.corners is 1; allowed: true, false ("),
    (
        {"discs": {"combinations": [{"number": 1, "force": 1.0}]}},
        "discs.combinations[0] lacks viscosity; needed:",
    ),
    ({"discs": {"combinations": 2 * [COMBINATION]}}, "discs.combinations: number 1 occurs twice"),
    ({"discs": {"combinations": [COMBINATION | {"rms": 0.1}]}}, "rms 0.1 in combination 1 of discs.combinations is"),
    ({"discs": {"combinations": [COMBINATION | {"diameter": 10.0, "rms": 1e-12}]}}, "rms 1e-12 in combination 1"),
    ({"variants": {"cases": [{"name": "nothing"}]}}, "variants.cases[0] changes nothing; allowed: a name and a key"),
    ({"variants": {"cases": [{"name": "law", "period": 2.0}]}}, "variants.cases[0].name is 'law'; allowed"),
    ({"variants": {"cases": [{"name": "wider\n", "period": 2.0}]}}, r"variants.cases[0].name is 'wider\n'; allowed"),
    ({"methods": {"tasks": []}}, "unknown key 'tasks' in methods; allowed: bodies, bodies_elements, elements"),
    ({"methods": {"elements": [33, 33]}}, "methods.elements: 33 occurs twice; allowed: once"),
    ({"media": {"cases": [FLUID | {"kind": "maxwell"}]}}, "fluid in media.cases: lacks shear_modulus; maxwell needs"),
    ({"media": {"cases": [FLUID | {"exponent": 0.5}]}}, "fluid in media.cases: unknown key 'exponent'; allowed for"),
    ({"lines": {"hurst": [0.4, 0.40000000001]}}, "lines.hurst[1] is 0.40000000001; allowed: 0 to 1, at most"),
    ({"discs": {"roll_off": {"wavelength": 0.01}}}, "discs.roll_off.wavelength: 0.01 is too short; allowed: from"),
    (
        {"periodic": {"roll_off": {"wavelength": 1e-9}}},
        "periodic.roll_off.wavelength: 1e-09 is too short; allowed: from",
    ),
    (
        {"surface": {"roll_off_wavelength": 3e-3}},
        "surface.roll_off_wavelength: 0.003 is too short; allowed: from 0.1212",
    ),
    ({"discs": {"hurst": [0.4, 0.33]}}, "discs.hurst has 0.33, lines.hurst has not"),
    ({"scaling": {"stiffness_range": [0.3, 0.03]}}, "scaling.stiffness_range: 0.3 and 0.03 are in the wrong order"),
    ({"periodic": {"x_low": 10, "x_high": 0.1}}, "periodic.x_low and x_high: 10 and 0.1 are in the wrong order"),
    ({"periodic": {"hurst": [0.1, 0.1]}}, "periodic.hurst: 0.1 occurs twice; allowed: once"),
    ({"lines": {"hurst": [0, 0.0, 0.1, 0.4, 0.6, 0.9]}}, "lines.hurst: 0 occurs twice; allowed: once"),
    (nested({"elements": 65}), "nested_grids.ensembles[0].grids[1].elements: 65 comes after 129; allowed: from coarse"),
    (nested({"elements": 258}), "nested_grids.ensembles[0].grids[1].elements: 258 is even; allowed: odd numbers"),
    (nested({"surfaces": 19}), "nested_grids.ensembles[0].grids[1].surfaces: 19 on the finest grid; allowed: at least"),
    (nested({"until_x": 0.5}), "nested_grids.ensembles[0].grids[1].until_x: 0.5 is above 0.1 of the next coarser grid"),
    (
        {"scaling": {"slope_half_width": 0.01}},
        "scaling.slope_half_width: 0.01 decades hold no further abscissa; allowed",
    ),
    ({"measured": [SCAN | {"forces": [1, 1.0]}]}, "measured[0].forces: 1 occurs twice; allowed: once"),
    (
        {"measured": [SCAN | {"spacing": [22.5, 1.8]}]},
        "measured[0].spacing is 22.5, 1.8; allowed: distances that differ",
    ),
    ({"measured": [SCAN | {"preparation": {"crop": [[0, 9], [5, 5]]}}]}, "measured[0].preparation.crop[1]: 5 to 5 is"),
]


@pytest.mark.parametrize(("wrong", "message"), WRONG, ids=[message[:30] for _, message in WRONG])
def test_wrong_settings_end_with_one_line(wrong, message):
    with pytest.raises(ValueError, match=re.escape(message)) as error:
        check_settings(merged(read_settings("config"), wrong))
    assert "\n" not in str(error.value)
    assert len(str(error.value)) < 250


def places(settings, path=()):
    """Yield the paths of all settings, with the first item of each list."""
    if path:
        yield path
    for key in (
        settings if isinstance(settings, dict) else range(min(len(settings), 1)) if isinstance(settings, list) else ()
    ):
        yield from places(settings[key], (*path, key))


@pytest.mark.parametrize(
    "odd",
    [object(), 10**400, {"a\nb": 1}, [[None]]],
    ids=["object", "huge", "two lines", "nested list"],
)
def test_odd_value_of_any_setting_is_reported_in_one_line_with_its_key(odd):
    scan = SCAN | {"spacing": [1.0], "preparation": {"crop": [[0, 1], [0, 1]], "flip": True}, "poisson_ratio": 0.3}
    settings = merged(read_settings("config"), {"measured": [scan]})
    for *above, last in places(settings):
        changed = copy.deepcopy(settings)
        section = functools.reduce(operator.getitem, above, changed)
        section[last] = odd
        with pytest.raises(
            ValueError, match=next(key for key in [last, *above[::-1]] if isinstance(key, str))
        ) as error:
            check_settings(changed)
        assert "\n" not in str(error.value)


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
        check_settings(merged(merged(default, other), change), sources)


@pytest.mark.parametrize("name", ["config", "paper", "methods", "test"])
def test_settings_of_every_scale_are_valid(name):
    check_settings(merged(read_settings("config"), read_settings(name)))


def test_settings_of_a_run_replace_lists_and_merge_mappings(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("mine.yaml").write_text("lines: {hurst: [0.1, 0.4, 0.6, 0.9]}\n")
    given = {"lines": {"hurst": [0.1, 0.4, 0.6, 0.9]}, "seed": 5}
    completed, sources = complete_settings(ROOT / "config/config.yaml", given, [Path("mine.yaml")], {"seed": 5})
    assert completed == merged(read_settings("config"), given)
    assert completed["lines"]["points"] == read_settings("config")["lines"]["points"]
    assert list(sources) == [str(ROOT / "config/config.yaml"), "the settings of the module", "mine.yaml", "--config"]
    with pytest.raises(ValueError, match=r"^--config: seed is -1; "):
        complete_settings(ROOT / "config/config.yaml", given | {"seed": -1}, [], {"seed": -1})


def test_changed_settings_are_named_with_both_values():
    default = read_settings("config")
    changed = changed_settings(default, merged(default, {"seed": 5, "lines": {"points": 4096, "batch": 500}}))
    assert changed == {"seed": (5, 2013), "lines.points": (4096, 131072)}


def parts(rule, path=""):
    """Yield (key, part of the schema) of every setting, at any depth."""
    rule = resolved(rule)
    yield path, rule
    for name, inner in rule.get("properties", {}).items():
        yield from parts(inner, f"{path}.{name}")
    if "items" in rule:
        yield from parts(rule["items"], f"{path}[]")


def test_every_setting_has_a_meaning_and_limits():
    found = dict(parts(schema()))
    assert len(found) > 150
    for key, rule in found.items():
        assert rule.get("description") or key.endswith("[]"), key
        kinds = {*rule["type"]} if isinstance(rule["type"], list) else {rule["type"]}
        if "object" in kinds:
            assert rule["additionalProperties"] is False, key
        elif "array" in kinds:
            assert {"minItems", "maxItems"} <= set(rule), key
        elif {"integer", "number"} & kinds:
            assert {"unit", "maximum"} <= set(rule), key
            assert {"minimum", "exclusiveMinimum"} & set(rule), key
        else:
            assert {"enum", "pattern"} & set(rule) or "boolean" in kinds, key


@pytest.mark.parametrize("name", ["config", "paper", "methods", "test"])
def test_schema_accepts_the_settings_of_every_scale(name):
    """Editors use the schema; the workflow uses the model."""
    settings = merged(read_settings("config"), read_settings(name))
    jsonschema.Draft202012Validator.check_schema(schema())
    jsonschema.validate(settings, schema())
    with pytest.raises(jsonschema.ValidationError, match="elemnts"):
        jsonschema.validate(merged(settings, {"discs": {"elemnts": 33}}), schema())
