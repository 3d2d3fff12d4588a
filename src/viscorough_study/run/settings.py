"""Complete the settings of a run with the default settings, and check them.

If settings are wrong, the error message describes the first fault in one line. The model of the settings
(run.settings_model) has types, limits and rules. Default values are in config/config.yaml.
"""

import difflib
from functools import cache
from pathlib import Path

from pydantic import ValidationError

from viscorough_study.run.setting_types import Schema
from viscorough_study.run.settings_files import read_settings_file
from viscorough_study.run.settings_model import Settings
from viscorough_study.run.settings_rules import name_of


def complete_settings(defaults, given, files, options):
    """Return the settings of a run, completed with default settings, and the sources for `check_settings`.

    defaults : path of the file of the default settings
    given : all settings of this run, from files, from the command line, or from a workflow that uses this workflow as a
        module
    files, options : paths of settings files, and settings from the command line. They only serve to name the source of
        a wrong setting in messages.
    Raises ValueError, one line that names a file, for the first file that cannot be read or the first wrong setting.
    """
    sources = {path_shown(defaults): read_settings_file(defaults), "the settings of the module": given}
    sources |= {path_shown(path): read_settings_file(path) for path in files} | {"--config": options}
    completed = _merged(sources[path_shown(defaults)], given)
    check_settings(completed, sources)
    return completed, sources


def _merged(base, changes):
    """Return settings with changes applied: mappings are merged at any depth, other values are replaced."""
    if not (isinstance(base, dict) and isinstance(changes, dict)):
        return changes
    return base | {key: _merged(base.get(key), value) for key, value in changes.items()}


def changed_settings(defaults, settings, above=()):
    """Return the settings that differ from the defaults, {name such as "discs.hurst": (value, default value)}.

    defaults, settings : mappings of all settings, with the same keys; above : keys of the mapping that contains them
    """
    changed = {}
    for key, value in settings.items():
        default, path = defaults.get(key), (*above, key)
        if isinstance(value, dict) and isinstance(default, dict):
            changed |= changed_settings(default, value, path)
        elif value != default:
            changed[name_of(path)] = (value, default)
    return changed


def path_shown(path):
    """Return a path for messages: relative to the working directory if the file lies in it, otherwise unchanged."""
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path)


def check_settings(settings, sources=None):
    """Raise ValueError unless the settings agree with their model.

    settings : mapping of all settings
    sources : {name of a source, such as a file: settings from this source}. Later sources override earlier sources.
        Messages name the source of a wrong setting. By default messages name no source.
    The message is one line with the source, the key, the value, and the allowed values.
    """
    try:
        Settings.model_validate(settings)
    except ValidationError as error:
        paths, complaint = _complaint(min(error.errors(include_url=False), key=lambda found: len(found["loc"])))
        names = dict.fromkeys(filter(None, (source_of(path, sources or {}) for path in paths)))
        raise ValueError(": ".join(filter(None, [" and ".join(names), complaint]))) from None


def source_of(path, sources):
    """Return the name of the last source that contains a setting, or None.

    path : keys of the setting, such as ["discs", "hurst"]; sources : see `check_settings`
    """
    for name, value in reversed(sources.items()):
        for key in path:
            try:
                value = value[key]
            except (KeyError, IndexError, TypeError):
                break
        else:
            return name
    return None


def _complaint(error):
    """Return the paths of the settings that are wrong, and a line about them, from an error of pydantic.

    error : first entry of the `errors` of a pydantic.ValidationError
    """
    path, kind = list(error["loc"]), error["type"]
    name, above = name_of(path) or "settings", name_of(path[:-1]) or "settings"
    if kind == "contradiction":
        return error["ctx"]["paths"], error["msg"]
    if kind in ("extra_forbidden", "invalid_key"):
        keys = sorted(_rule(path[:-1])["properties"])
        close = difflib.get_close_matches(str(path[-1]), keys, 1)
        hint = f"did you mean {close[0]}?" if close else f"allowed: {', '.join(keys)}"
        return [path], f"unknown key {str(path[-1])!r:.60} in {above}; {hint}"
    if kind == "missing":
        return [path[:-1]], f"{above} lacks {path[-1]}; needed: {', '.join(_rule(path[:-1])['required'])}"
    if kind == "twice":
        return [path], f"{name}: {error['msg']}"
    if kind == "changes nothing":
        return [path], f"{name} {error['msg']}"
    value, rule = error["input"], _rule(path)
    is_text = isinstance(value, str) and "number" in rule.get("type", ())
    hint = "; this is text: write numbers as 1.0e-3, with a point" * is_text
    value = "empty" if value is None else repr(value)
    return [path], f"{name} is {value:.60}; allowed: {allowed(rule)}{_unit(rule)} ({_gist(path)}){hint}"


# ---- JSON schema; the part of the schema that describes a setting is called a rule


@cache
def schema():
    """Return the JSON schema of the settings."""
    return Settings.model_json_schema(schema_generator=Schema)


def resolved(rule):
    """Return a part of the JSON schema. If this part is only a reference to a definition, return the definition."""
    return schema()["$defs"][rule["$ref"].rpartition("/")[2]] if "$ref" in rule else rule


def _rule(path):
    """Return the part of the JSON schema that describes the setting at a path, such as ["discs", "hurst"]."""
    rule = schema()
    for key in path:
        rule = resolved(rule["items"] if isinstance(key, int) else rule["properties"][key])
    return rule


def allowed(rule):
    """Return the values that a part of the JSON schema allows, in words, such as "integer, 9 to 4097"."""
    rule = resolved(rule)
    kinds = rule["type"] if isinstance(rule["type"], list) else [rule["type"]]
    if "allowed" in rule:
        return rule["allowed"]
    if "enum" in rule:
        return ", ".join(rule["enum"])
    if "boolean" in kinds:
        return "true, false"
    if "object" in kinds:
        return "a mapping"
    if "array" in kinds:
        return _allowed_items(rule)
    low = _short(rule["minimum"]) if "minimum" in rule else f"> {_short(rule['exclusiveMinimum'])}"
    parts = ["integer" * ("integer" in kinds), f"{low} to {_short(rule['maximum'])}"]
    parts += [f"at most {rule['decimals']} decimals" if "decimals" in rule else "", "null" * ("null" in kinds)]
    return ", ".join(filter(None, parts))


# {type of the items of a list: (noun for the items, words before the allowed values of an item)}, as in "integers, each
# 1 to 9"
_ITEMS = {
    "integer": ("integers", ", each"),
    "number": ("numbers", ", each"),
    "string": ("texts", ", each"),
    "array": ("lists", " of"),
}


def _allowed_items(rule):
    least, most, items = rule["minItems"], rule["maxItems"], resolved(rule["items"])
    number, once = f"{least}" if least == most else f"{least} to {most}", rule.get("eachOnce")
    if items["type"] == "object":
        return f"{number} mappings" + (f", no `{once}` twice" if once else "")
    noun, connection = ("values", " of") if "enum" in items else _ITEMS[items["type"]]
    return f"{number} {noun}{connection} {allowed(items).removeprefix('integer, ')}" + ", none twice" * bool(once)


def unit_of(rule):
    """Return the unit of a setting or, for a list, of its items; "" if there is no unit."""
    rule = resolved(rule)
    unit = unit_of(rule["items"]) if "items" in rule else rule.get("unit", "1")
    return "" if unit == "1" else unit


def _unit(rule):
    unit = unit_of(rule)
    return f" {unit}" if unit and "items" not in rule else ""


def _gist(path):
    """Return the description of a setting up to its first semicolon.

    For an item of a list that has no description, the description of the list is returned.
    """
    meaning = next(filter(None, (_rule(path[:end]).get("description") for end in range(len(path), -1, -1))))
    return meaning.partition(";")[0].rstrip(".")


def _short(number):
    """Return a number as short text, such as 10000, 0.01, 1e-8."""
    if isinstance(number, int):
        return str(number)
    mantissa, _, exponent = f"{number:g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa
