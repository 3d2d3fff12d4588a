"""The check of the settings, and the settings of every scale."""

import copy
import functools
import json
import operator
import re
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest
import yaml

from support.workflow import ROOT, merged, read_settings
from viscorough_study.run.settings import changed_settings, check_settings, complete_settings

SCALES = ["config", "paper", "methods", "fine_grids", "test"]
COMBINATION = {"number": 1, "force": 1.0, "viscosity": 1.0, "diameter": 1.0, "rms": 1e-3}
SCAN = {"name": "scan", "files": ["z.npy"]}
FLUID = {"name": "fluid", "kind": "newtonian", "viscosity": 1.0}


def fine(changed):
    """Return settings of two grids of the same discs of which the finer grid has changed values."""
    grids = [{"elements": elements, "surfaces": 20, "until_x": 0.1, "batch": 20} for elements in (129, 257)]
    return {"fine_grids": {"ensembles": [{"hurst": 0.4, "grids": [grids[0], grids[1] | changed]}]}}


def media(changed):
    return {"kinetics": {"media": [FLUID | changed]}}


WRONG = [
    ({"discs": {"elemnts": 33}}, "discs.elemnts: unknown key; did you mean elements?"),
    ({"dis\ncs": 1}, "dis cs: unknown key; did you mean discs?"),
    ({"discs": {"elements": 5}}, "discs.elements: Input should be greater than or equal to 9 (it is 5)"),
    ({"discs": {"realizations": True}}, "discs.realizations: Input should be a valid integer (it is True)"),
    ({"discs": None}, "discs: Input should be a valid dictionary or instance of Discs (it is None)"),
    ({"hurst": [0.4, 1.2]}, "hurst[1]: Input should be less than or equal to 1 (it is 1.2)"),
    ({"hurst": [0.4, 0.40000000001]}, "hurst[1]: at most four decimals are allowed"),
    ({"hurst": [0, 0.4, 0.0]}, "hurst: the value 0.0 occurs twice"),
    ({"curves": {"tolerance": "1e-3"}}, "(it is '1e-3'); this is text: write numbers as 1.0e-3, with a point"),
    ({"curves": {"until_x": float("nan")}}, "curves.until_x: Input should be a finite number (it is nan)"),
    ({"curves": {"until_x": 1e-9}}, "curves: x_low and until_x: 1e-09 and 1e-09; the second must be at least ten"),
    ({"surface": {"amplitudes": "all"}}, "surface.amplitudes: Input should be 'random' or 'fixed' (it is 'all')"),
    ({"discs": {"combinations": [{"number": 1}]}}, "discs.combinations[0].force: Field required"),
    ({"discs": {"combinations": 2 * [COMBINATION]}}, "discs.combinations: number 1 occurs twice"),
    ({"discs": {"variants": {"surfaces": [{"name": "nothing"}]}}}, "discs.variants.surfaces[0]: it changes nothing;"),
    ({"discs": {"variants": {"surfaces": [{"name": "law", "period": 2.0}]}}}, "discs.variants.surfaces[0]: the names"),
    ({"discs": {"roll_off": {"wavelength": 0.01}}}, "discs.roll_off.wavelength: 0.01 is too short; at least 0.01556,"),
    (media({"kind": "maxwell"}), "kinetics.media[0]: lacks shear_modulus; maxwell needs"),
    (media({"exponent": 0.5}), "kinetics.media[0]: unknown key 'exponent'; allowed for"),
    ({"scaling": {"stiffness_range": [0.3, 0.03]}}, "scaling: stiffness_range: 0.3 and 0.03; the second must be above"),
    ({"scaling": {"slope_half_width": 0.01}}, "scaling.slope_half_width: 0.01 decades hold no further abscissa; at"),
    (fine({"elements": 258}), "fine_grids.ensembles[0]: grids: 258 elements; odd numbers are needed"),
    (fine({"surfaces": 19}), "fine_grids.ensembles[0]: grids: 19 surfaces on the finest grid; at least 20 are needed"),
    (fine({"until_x": 0.5}), "fine_grids.ensembles[0]: grids: until_x is 0.5 on the grid of 257, 0.1 on the next"),
    ({"measured": [SCAN | {"unit": "banana"}]}, "measured[0].unit: "),
    ({"measured": [SCAN | {"files": ["{A}.npy"]}]}, "measured[0].files[0]: '{A}.npy' has a brace or"),
    ({"measured": [SCAN | {"spacing": [22.5, 1.8]}]}, "measured[0]: spacing: the distances must differ by at most"),
    ({"measured": [SCAN | {"preparation": {"crop": [[0, 9], [5, 5]]}}]}, "preparation: crop: 5 to 5 is empty;"),
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
    keys = (
        settings if isinstance(settings, dict) else range(min(len(settings), 1)) if isinstance(settings, list) else ()
    )
    for key in keys:
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


def test_order_of_lists_and_spelling_of_numbers_do_not_matter():
    """Even of lists in items of lists; the pairs of a range, a crop and a spacing keep their order."""
    scan = SCAN | {"files": ["b", "a"], "forces": [2, 1], "spacing": [2, 1]}
    settings = merged(merged(read_settings("config"), read_settings("fine_grids")), {"measured": [scan]})
    changed = copy.deepcopy(settings)
    lists = [path for path in places(settings) if isinstance(functools.reduce(operator.getitem, path, settings), list)]
    for path in lists:
        if path[-1] not in ("stiffness_range", "spacing"):
            functools.reduce(operator.getitem, path, changed).reverse()
    changed["kinetics"]["times"]["high"] = 10_000
    assert json.dumps(check_settings(changed)) == json.dumps(check_settings(settings))


@pytest.mark.parametrize(
    ("mine", "given", "message"),
    [
        ("discs: {elemnts: 33}", {}, "mine.yaml: discs.elemnts: unknown key"),
        ("scaling: {slope_half_width: 0.03}", {}, "mine.yaml: scaling.slope_half_width: 0.03 decades hold no"),
        ("curves: {x_low: 1.0}", {"curves": {"x_low": 1.0}}, "mine.yaml: curves: x_low and short_until_x: 1 and 1.8;"),
        ("seed: 5", {"seed": -1}, "the settings of --config or of the module: seed: Input should be"),
    ],
)
def test_source_of_a_wrong_setting_is_named(tmp_path, monkeypatch, mine, given, message):
    """Even if the fault is a contradiction between this setting and a default."""
    monkeypatch.chdir(tmp_path)
    Path("first.yaml").write_text("seed: 7\n")
    Path("mine.yaml").write_text(mine)
    given = merged({"seed": 7} | yaml.safe_load(mine), given)
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        complete_settings(ROOT / "config/config.yaml", given, [Path("first.yaml"), Path("mine.yaml")])


@pytest.mark.parametrize("name", SCALES)
def test_settings_of_every_scale_are_valid(name):
    check_settings(merged(read_settings("config"), read_settings(name)))


def test_settings_of_a_run_replace_lists_and_merge_mappings():
    given = {"hurst": [0.7], "lines": {"batch": 5}}
    completed = complete_settings(ROOT / "config/config.yaml", given)
    assert completed == check_settings(merged(read_settings("config"), given))
    assert (completed["hurst"], completed["lines"]["points"]) == ([0.7], read_settings("config")["lines"]["points"])


def test_changed_settings_are_named_with_both_values():
    default = read_settings("config")
    changed = changed_settings(default, merged(default, {"seed": 5, "lines": {"points": 4096, "batch": 500}}))
    assert changed == {"seed": (5, 2013), "lines.points": (4096, 131072)}


def test_schema_for_editors_accepts_partial_files_and_no_other_keys():
    command = [sys.executable, "-m", "viscorough_study.run.settings"]
    schema = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    for name in SCALES:
        jsonschema.validate(read_settings(name), schema)
    for wrong in ({"discs": {"elemnts": 33}}, {"seed": "many"}, {"discs": {"combinations": [{"number": 1}]}}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(wrong, schema)
