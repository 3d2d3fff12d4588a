"""Validation of the settings, by their schema and against each other: one line for the first error.

In addition to the keywords of JSON schemas, the schema has `eachOnce` for lists of distinct entries, or, with the name
of a key, of mappings distinct in that key; and `decimals`, the largest number of decimals, so that different Hurst
exponents have different file names.
"""

import difflib
import math
from itertools import chain

import jsonschema

# Keywords of a schema that an error message quotes.
_LIMITS = ("type", "enum", "minimum", "exclusiveMinimum", "maximum", "minItems", "maxItems", "decimals")


def check_settings(settings, schema):
    """Raise ValueError unless the settings agree with the schema and with each other.

    schema : of JSON, with a unit and a description for every key
    The message is one line with key, value and allowed values.
    """
    standard = jsonschema.Draft202012Validator
    checker = standard.TYPE_CHECKER.redefine_many({"integer": _is_whole, "number": _is_finite})
    keywords = {"eachOnce": _each_once, "decimals": _decimals}
    validator = jsonschema.validators.extend(standard, keywords, type_checker=checker)
    error = jsonschema.exceptions.best_match(validator(schema).iter_errors(settings))
    checks = (_disc_without_line, _unlike_lengths, _too_short_wave, _empty_range, _too_short_curve)
    contradictions = chain.from_iterable(check(settings) for check in (*checks, _wrong_medium))
    if complaint := _schema_complaint(error) if error else next(contradictions, None):
        raise ValueError(complaint)


def _is_whole(_, value):
    return isinstance(value, int) and not isinstance(value, bool)  # JSON would take 3.0


def _is_finite(_, value):
    return (_is_whole(_, value) or isinstance(value, float)) and math.isfinite(value)  # YAML has .inf and .nan


def _each_once(_, key, entries, __):
    if isinstance(entries, list):
        values = [f"{key} {entry.get(key)}" if isinstance(entry, dict) else f"{entry}" for entry in entries]
        for value in (value for value in values if values.count(value) > 1):
            yield jsonschema.ValidationError(f"{value} occurs twice; allowed: once")


def _decimals(_, number, value, __):
    if _is_finite(_, value) and value != round(value, number):
        yield jsonschema.ValidationError("too many decimals")


# ---- against the schema


def _schema_complaint(error):
    """One line on an error of jsonschema."""
    key, rule = error.json_path[2:] or "settings", error.schema  # without "$."
    if error.validator == "additionalProperties":
        known = sorted(rule["properties"])
        unknown = min(map(str, set(error.instance) - set(known)))
        close = difflib.get_close_matches(unknown, known, 1)
        hint = f"did you mean {close[0]}?" if close else f"allowed: {', '.join(known)}"
        return f"unknown key {unknown!r:.60} in {key}; {hint}"
    if error.validator in ("required", "eachOnce"):
        return f"{key}: {error.message}"
    value = "empty" if error.instance is None else repr(error.instance)
    limits = ", ".join(f"{name} {rule[name]}" for name in _LIMITS if name in rule)
    unit = f" {rule['unit']}" if rule.get("unit", "1") != "1" else ""
    is_text = isinstance(error.instance, str) and "number" in str(rule.get("type"))
    hint = "; this is text: write numbers as 1.0e-3, with a point" * is_text
    return f"{key} is {value:.60}; allowed: {limits}{unit} ({rule['description']}){hint}"


# ---- against each other: one line on settings that are valid separately but not together


def _disc_without_line(settings):
    for hurst in settings["discs"]["hurst"]:
        if hurst not in settings["lines"]["hurst"]:
            yield f"discs.hurst has {hurst}, lines.hurst has not; allowed: exponents of lines.hurst (lambda needs both)"


def _unlike_lengths(settings):
    for combination in settings["discs"]["combinations"]:
        if not combination["diameter"] * 1e-12 <= combination["rms"] < combination["diameter"] / 100:
            where = f"combination {combination['number']} of discs.combinations"
            yield f"rms {combination['rms']} in {where} is out of range; allowed: below diameter/100, from 1e-12 of it"


def _too_short_wave(settings):
    sizes = settings["sizes"]
    coarsest = {"name": "sizes.control", "elements": min(grid["elements"] for grid in sizes["discs"])}
    for changed in [{"name": "surface"}, *settings["variants"]["cases"], coarsest | sizes["control"]]:
        surface = {"elements": settings["discs"]["elements"]} | settings["surface"] | changed
        wavelength = surface["roll_off_wavelength"]
        if wavelength is not None and wavelength * surface["elements"] < 4:
            yield f"roll_off_wavelength {wavelength} of {changed['name']} is too short; allowed: from four elements"


def _empty_range(settings):
    x_low, sizes, times = settings["ensemble"]["x_low"], settings["sizes"], settings["media"]["times"]
    decades = {
        "ensemble.x_low and x_high": (x_low, settings["ensemble"]["x_high"]),
        "reduction.x_low and x_high": (settings["reduction"]["x_low"], settings["reduction"]["x_high"]),
        "ensemble.x_low and indentation.until_x": (x_low, settings["indentation"]["until_x"]),
        "ensemble.x_low and sizes.until_x": (x_low, sizes["until_x"]),
        "media.times.low and high": (times["low"], times["high"]),
        **{f"sizes.windows[{i}]": window for i, window in enumerate(sizes["windows"])},
    }
    ranges = [(name, ends, 10) for name, ends in decades.items()]
    ranges.append(("scaling.stiffness_range", settings["scaling"]["stiffness_range"], 1.01))
    for name, (low, high), factor in ranges:
        if high < factor * low * (1 - 1e-9):  # rounding
            yield f"{name}: {low} and {high} are too close; allowed: the second from {factor} times the first"


def _too_short_curve(settings):
    end = settings["verdicts"]["plateau_range"][1] * 10 ** settings["scaling"]["slope_half_width"]
    for section, name in (("discs", "short_until_x"), ("indentation", "until_x")):
        if (until_x := settings[section][name]) < end:
            what = "verdicts.plateau_range and half a slope's width"
            yield f"{section}.{name}: curves that end at X = {until_x} miss a part of {what}; allowed: from {end:.4g}"


def _wrong_medium(settings):
    from viscorough.io.media import medium_from_mapping  # takes long to import

    for case in settings["media"]["cases"]:
        try:
            medium_from_mapping({key: value for key, value in case.items() if key != "name"})
        except ValueError as error:
            yield f"{case['name']} in media.cases: {error}"
