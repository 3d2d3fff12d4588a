"""Validate the settings, by their schema and against each other, with one line for the first error.

In addition to the keywords of JSON schemas, the schema has `eachOnce` and `decimals`. `eachOnce` requires distinct
entries of a list or, with the name of a key, mappings that differ in this key. `decimals` is the largest number of
decimals, so different Hurst exponents have different file names.
"""

import difflib
import functools
import math
import operator
from itertools import chain
from pathlib import Path

import jsonschema

from viscorough_study.run.settings_files import read_settings_file

# Schema keywords that an error message quotes.
_LIMITS = ("type", "enum", "minimum", "exclusiveMinimum", "maximum", "minItems", "maxItems", "decimals")


def complete_settings(defaults, schema, given, files, options):
    """Return the settings of a run, default settings where no others are given, and the sources of `check_settings`.

    defaults : file of the default settings; schema : as in `check_settings`
    given : all settings given by files, by the command line, or by a workflow that uses this workflow as a module
    files : files of settings; options : settings of the command line
    Raises ValueError, one line with a file, for the first file that cannot be read, or for the first wrong setting.
    """
    sources = {_shown(defaults): read_settings_file(defaults), "the settings of the module": given}
    sources |= {_shown(path): read_settings_file(path) for path in files} | {"--config": options}
    completed = _merged(sources[_shown(defaults)], given)
    check_settings(completed, schema, sources)
    return completed, sources


def _merged(base, changes):
    """Return settings with changes: mappings are merged at any depth, everything else is replaced."""
    if not (isinstance(base, dict) and isinstance(changes, dict)):
        return changes
    return base | {key: _merged(base.get(key), value) for key, value in changes.items()}


def _shown(path):
    """Return a path from the folder of the run, if it is in there."""
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path)


def check_settings(settings, schema, sources=None):
    """Raise ValueError unless the settings agree with the schema and with each other.

    schema : JSON schema, with a unit and a description for every key
    sources : {name: settings that it gives}; later sources override earlier ones; by default messages name no source
    The message is one line with the source, key, value and allowed values.
    """
    standard = jsonschema.Draft202012Validator
    checker = standard.TYPE_CHECKER.redefine_many({"integer": _is_whole, "number": _is_finite})
    keywords = {"eachOnce": _each_once, "decimals": _decimals}
    validator = jsonschema.validators.extend(standard, keywords, type_checker=checker)
    error = jsonschema.exceptions.best_match(validator(schema).iter_errors(settings))
    contradictions = chain.from_iterable(check(settings) for check in _CROSS_CHECKS)
    if found := _schema_complaint(error) if error else next(contradictions, None):
        paths, complaint = found
        names = dict.fromkeys(filter(None, (source_of(path, sources or {}) for path in paths)))
        raise ValueError(": ".join(filter(None, [" and ".join(names), complaint])))


def source_of(path, sources):
    """Return the name of the last source that gives a setting, or None; path : its keys, as ["discs", "hurst"]."""
    for name, value in reversed(sources.items()):
        for key in path:
            try:
                value = value[key]
            except (KeyError, IndexError, TypeError):
                break
        else:
            return name
    return None


def _is_whole(_, value):
    return isinstance(value, int) and not isinstance(value, bool)  # JSON would accept 3.0


def _is_finite(_, value):
    return (_is_whole(_, value) or isinstance(value, float)) and math.isfinite(value)  # YAML has .inf and .nan


def _each_once(_, key, entries, __):
    if isinstance(entries, list):
        values = [entry.get(key) if isinstance(entry, dict) else entry for entry in entries]
        for value in (value for value in values if values.count(value) > 1):
            name = f"{key} " if isinstance(key, str) else ""
            yield jsonschema.ValidationError(f"{name}{value} occurs twice; allowed: once")


def _decimals(_, number, value, __):
    if _is_finite(_, value) and value != round(value, number):
        yield jsonschema.ValidationError("too many decimals")


# ---- against the schema


def _schema_complaint(error):
    """Return paths of the settings that an error of jsonschema is about, and one line on it."""
    key, rule, path = error.json_path[2:] or "settings", error.schema, list(error.absolute_path)  # key without "$."
    if error.validator == "additionalProperties":
        known = sorted(rule["properties"])
        unknown = min(set(error.instance) - set(known), key=str)
        close = difflib.get_close_matches(str(unknown), known, 1)
        hint = f"did you mean {close[0]}?" if close else f"allowed: {', '.join(known)}"
        return [[*path, unknown]], f"unknown key {str(unknown)!r:.60} in {key}; {hint}"
    if error.validator in ("required", "eachOnce"):
        return [path], f"{key}: {error.message}"
    value = "empty" if error.instance is None else repr(error.instance)
    limits = ", ".join(f"{name} {rule[name]}" for name in _LIMITS if name in rule)
    unit = f" {rule['unit']}" if rule.get("unit", "1") != "1" else ""
    is_text = isinstance(error.instance, str) and "number" in str(rule.get("type"))
    hint = "; this is text: write numbers as 1.0e-3, with a point" * is_text
    return [path], f"{key} is {value:.60}; allowed: {limits}{unit} ({rule['description']}){hint}"


# ---- against each other: paths of settings that are valid separately but not together, and one line on them


def _disc_without_line(settings):
    for hurst in settings["discs"]["hurst"]:
        if hurst not in settings["lines"]["hurst"]:
            text = (
                f"discs.hurst has {hurst}, lines.hurst has not; allowed: exponents of lines.hurst (lambda needs both)"
            )
            yield [["discs", "hurst"], ["lines", "hurst"]], text


def _unlike_lengths(settings):
    for combination in settings["discs"]["combinations"]:
        if not combination["diameter"] * 1e-12 <= combination["rms"] < combination["diameter"] / 100:
            where = f"combination {combination['number']} of discs.combinations"
            text = f"rms {combination['rms']} in {where} is out of range; allowed: below diameter/100, from 1e-12 of it"
            yield [["discs", "combinations"]], text


def _too_short_wave(settings):
    sizes, cases = settings["sizes"], settings["variants"]["cases"]
    coarsest = {"name": "sizes.control", "elements": min(grid["elements"] for grid in sizes["discs"])}
    changes = [(["surface", "roll_off_wavelength"], {"name": "surface"})]
    changes += [(["variants", "cases", i], case) for i, case in enumerate(cases)]
    changes.append((["sizes", "control"], coarsest | sizes["control"]))
    for path, changed in changes:
        surface = {"elements": settings["discs"]["elements"]} | settings["surface"] | changed
        wavelength = surface["roll_off_wavelength"]
        if wavelength is not None and wavelength * surface["elements"] < 4:
            yield (
                [path],
                f"roll_off_wavelength {wavelength} of {changed['name']} is too short; allowed: from four elements",
            )


# Ends of ranges, and the smallest factor between them.
_RANGES = [
    ("ensemble.x_low", "ensemble.x_high", 10),
    ("reduction.x_low", "reduction.x_high", 10),
    ("periodic.x_low", "periodic.x_high", 10),
    ("media.times.low", "media.times.high", 10),
    ("ensemble.x_low", "indentation.until_x", 10),
    ("ensemble.x_low", "sizes.until_x", 10),
    ("ensemble.x_low", "verdicts.plateau_range.0", 1),
    ("verdicts.plateau_range.0", "verdicts.plateau_range.1", 10),
    ("verdicts.plateau_range.1", "ensemble.x_high", 1),
    ("scaling.stiffness_range.0", "scaling.stiffness_range.1", 1.01),
]
# {setting with a list: setting with the lower end for its entries, or None if each entry is a range itself}
_RANGES_IN_LISTS = {
    "sizes.windows": None,
    "collapse.x_high": "ensemble.x_low",
    "collapse.corrected_x_high": "ensemble.x_low",
}


def _empty_range(settings):
    ranges = list(_RANGES)
    for name, low in _RANGES_IN_LISTS.items():
        entries = [f"{name}.{i}" for i in range(len(_value(settings, _path(name))))]
        ranges += [(low, entry, 10) if low else (f"{entry}.0", f"{entry}.1", 10) for entry in entries]
    for low_name, high_name, factor in ranges:
        paths = _path(low_name), _path(high_name)
        low, high = (_value(settings, path) for path in paths)
        if high < factor * low * (1 - 1e-9):  # allows for rounding
            fault = "in the wrong order" if high < low else "too close"
            allowed = f"the second from {factor} times the first"
            yield paths, f"{_range_name(*paths)}: {low} and {high} are {fault}; allowed: {allowed}"


def _path(name):
    """Return the path of a setting from its name with points; whole numbers are positions in a list."""
    return [int(key) if key.isdecimal() else key for key in name.split(".")]


def _value(settings, path):
    return functools.reduce(operator.getitem, path, settings)


def _name(path):
    """Return the name of a setting as in messages: sizes.windows[0]."""
    return "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path)[1:]


def _range_name(low, high):
    """Return the name of a range from the paths of its ends."""
    if low[:-1] != high[:-1]:
        return f"{_name(low)} and {_name(high)}"
    return f"{_name(low)} and {high[-1]}" if isinstance(low[-1], str) else _name(low[:-1])


def _too_narrow_slope(settings):
    half_width, per_decade = settings["scaling"]["slope_half_width"], settings["ensemble"]["per_decade"]
    if half_width * per_decade < 1 - 1e-9:
        text = (
            f"scaling.slope_half_width: {half_width} decades hold no further abscissa; allowed: from 1/per_decade of "
        )
        yield [["scaling", "slope_half_width"], ["ensemble", "per_decade"]], f"{text}ensemble, {1 / per_decade:.4g}"


def _too_short_curve(settings):
    plateau = ["verdicts", "plateau_range", 1]
    end = _value(settings, plateau) * 10 ** settings["scaling"]["slope_half_width"]
    for section, name in (("discs", "short_until_x"), ("indentation", "until_x")):
        if (until_x := settings[section][name]) < end:
            what = "verdicts.plateau_range and half a slope's width"
            text = f"{section}.{name}: curves that end at X = {until_x} miss a part of {what}; allowed: from {end:.4g}"
            yield [[section, name], plateau], text


def _wrong_medium(settings):
    from viscorough.io.media import medium_from_mapping  # this import takes long

    for i, case in enumerate(settings["media"]["cases"]):
        try:
            medium_from_mapping({key: value for key, value in case.items() if key != "name"})
        except ValueError as error:
            yield [["media", "cases", i]], f"{case['name']} in media.cases: {error}"


def _empty_crop(settings):
    for i, entry in enumerate(settings["measured"]):
        for j, (first, end) in enumerate(entry.get("preparation", {}).get("crop", [])):
            if first >= end:
                path = ["measured", i, "preparation", "crop", j]
                yield [path], f"{_name(path)}: {first} to {end} is empty; allowed: an end above the first number"


_CROSS_CHECKS = (
    _disc_without_line,
    _unlike_lengths,
    _too_short_wave,
    _empty_range,
    _too_narrow_slope,
    _too_short_curve,
    _wrong_medium,
    _empty_crop,
)
