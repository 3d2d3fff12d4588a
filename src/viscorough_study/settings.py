"""The check of the settings, by their schema and against each other: one line for the first error."""

import difflib
import math

import jsonschema

# Groups of cases that every run has, and which variants can therefore not be called (viscorough_study.cases).
GROUPS = ("base", "controls", "lines", "sizes")
_RANGES = ("ensemble", "reduction")  # sections with a range of X


class SettingsError(ValueError):
    """A setting that is not allowed; the message is one line that names key, value and what is allowed."""


def check_settings(settings, schema):
    """Raise SettingsError unless the settings agree with the schema and with each other.

    schema : of JSON, with a unit and a description for every key
    """
    standard = jsonschema.Draft202012Validator
    checker = standard.TYPE_CHECKER.redefine_many({"integer": _is_whole, "number": _is_finite})
    validator = jsonschema.validators.extend(standard, type_checker=checker)
    error = jsonschema.exceptions.best_match(validator(schema).iter_errors(settings))
    complaint = _schema_complaint(error) if error else _contradiction(settings)
    if complaint:
        raise SettingsError(complaint)


def _is_whole(_, value):
    return isinstance(value, int) and not isinstance(value, bool)  # JSON would take 3.0


def _is_finite(_, value):
    return (_is_whole(_, value) or isinstance(value, float)) and math.isfinite(value)  # YAML has .inf and .nan


# ---- against the schema


def _dotted(path):
    """A key as the documentation writes it, such as discs.combinations[0].force."""
    return "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path).lstrip(".") or "settings"


def _in_one_line(text):
    return text[:60] if text.isprintable() else repr(text)[:60]


def _schema_complaint(error):
    """One line on an error of jsonschema."""
    key = _dotted(error.absolute_path)
    within = f" in {key}" if error.absolute_path else ""
    if error.validator == "additionalProperties":
        known = sorted(error.schema["properties"])
        unknown = _in_one_line(sorted(map(str, set(error.instance) - set(known)))[0])
        close = difflib.get_close_matches(unknown, known, 1)
        hint = f"did you mean {close[0]}?" if close else f"allowed: {', '.join(known)}"
        return f"unknown key {unknown}{within}; {hint}"
    if error.validator == "required":
        missing = next(name for name in error.validator_value if name not in error.instance)
        return f"{missing}{within} is missing; needed: {', '.join(error.validator_value)}"
    value = "empty" if error.instance is None else f"{error.instance!r}"[:60]
    hint = ""
    if isinstance(error.instance, str) and "number" in str(error.schema.get("type")):
        hint = "; this is text: write numbers as 1.0e-3, with a point"
    return f"{key} is {value}; allowed: {_allowed(error.schema)}{hint}"


def _allowed(rule):
    """What a schema allows, in words."""
    kinds = {"integer": "a whole number", "number": "a number", "string": "text", "array": "a list"}
    kinds |= {"boolean": "true or false", "object": "keys with values", "null": "null"}
    types = rule.get("type", [])
    words = " or ".join(kinds[kind] for kind in ([types] if isinstance(types, str) else types))
    words += f"one of {', '.join(rule['enum'])}" if "enum" in rule else ""
    bounds = {"minimum": "from {}", "exclusiveMinimum": "above {}", "maximum": "up to {}"}
    bounds |= {"minItems": "of at least {}", "maxItems": "of at most {}", "minProperties": "of at least {}"}
    words += "".join(f" {text.format(rule[name])}" for name, text in bounds.items() if name in rule)
    words += f" {rule['unit']}" if rule.get("unit", "1") != "1" and "enum" not in rule else ""
    return f"{words} ({rule['description']})"


# ---- against each other


def _contradiction(settings):
    """One line on settings that are allowed one by one but not together, or None."""
    checks = (_reserved, _repeated, _too_precise, _disc_without_line, _too_rough, _too_smooth)
    checks += (_decreasing_task, _too_short_wave, _empty_range, _too_short_curve, _wrong_medium)
    return next(filter(None, (check(settings) for check in checks)), None)


def _reserved(settings):
    for variant in settings["variants"]["cases"]:
        if variant["name"] in GROUPS:
            return f"name {variant['name']} in variants.cases is taken; allowed: any but {', '.join(GROUPS)}"
    return None


def _repeated(settings):
    discs, sizes, methods = settings["discs"], settings["sizes"], settings["methods"]
    lists = {
        "discs.hurst": discs["hurst"],
        "lines.hurst": settings["lines"]["hurst"],
        "number in discs.combinations": [combination["number"] for combination in discs["combinations"]],
        "name in variants.cases": [variant["name"] for variant in settings["variants"]["cases"]],
        "validation.elements": settings["validation"]["elements"],
        **{f"methods.{key}": methods[key] for key in ("groups", "hurst", "bodies")},
        "methods.elements": methods["elements"],
        "methods.bodies_elements": methods["bodies_elements"],
        "name in measured": [group["name"] for group in settings["measured"]],
        "name in media.cases": [case["name"] for case in settings["media"]["cases"]],
        "name in methods.tasks": [task["name"] for task in methods["tasks"]],
        "stability.grids": settings["stability"]["grids"],
        "sizes.hurst": sizes["hurst"],
        "elements in sizes.discs": [grid["elements"] for grid in sizes["discs"]],
        "points in sizes.lines": [grid["points"] for grid in sizes["lines"]],
        "large.elements": settings["large"]["elements"],
    }
    for key, values in lists.items():
        for value in values:
            if values.count(value) > 1:
                return f"{key}: {value} occurs twice; allowed: once"
    return None


def _too_precise(settings):
    exponents = {f"{part}.hurst": settings[part]["hurst"] for part in ("discs", "lines", "methods", "sizes")}
    exponents["sizes.control.hurst"] = [settings["sizes"]["control"]["hurst"]]
    for key, values in exponents.items():
        for hurst in values:
            if hurst != round(hurst, 4):  # so that different exponents have different file names
                return f"{key} has {hurst}; allowed: at most four decimals"
    return None


def _disc_without_line(settings):
    for hurst in settings["discs"]["hurst"]:
        if hurst not in settings["lines"]["hurst"]:
            return (
                f"discs.hurst has {hurst}, lines.hurst has not; allowed: exponents of lines.hurst (lambda needs both)"
            )
    return None


def _too_rough(settings):
    for combination in settings["discs"]["combinations"]:
        if not combination["rms"] < combination["diameter"] / 100:
            where = f"combination {combination['number']} of discs.combinations"
            return f"rms {combination['rms']} in {where} is too large; allowed: below diameter/100"
    return None


def _too_smooth(settings):
    for combination in settings["discs"]["combinations"]:
        if combination["rms"] < combination["diameter"] * 1e-12:
            where = f"combination {combination['number']} of discs.combinations"
            return f"rms {combination['rms']} in {where} is too small; allowed: from 1e-12 of the diameter"
    return None


def _decreasing_task(settings):
    for task in settings["methods"]["tasks"]:
        first, last = task["fractions"]
        if first > last:
            return f"fractions of {task['name']} in methods.tasks decrease; allowed: the first not above the second"
        if task["levels"] > 1 and last < 1.1 * first:
            return (
                f"fractions of {task['name']} in methods.tasks are too close; allowed: the second from 1.1 of the first"
            )
    return None


def _too_short_wave(settings):
    sizes = settings["sizes"]
    control = {
        "name": "sizes.control",
        "elements": min(grid["elements"] for grid in sizes["discs"]),
        **sizes["control"],
    }
    for changed in [{"name": "surface"}, *settings["variants"]["cases"], control]:
        surface = {"elements": settings["discs"]["elements"]} | settings["surface"] | changed
        wavelength = surface["roll_off_wavelength"]
        if wavelength is not None and wavelength * surface["elements"] < 4:
            return f"roll_off_wavelength {wavelength} of {changed['name']} is too short; allowed: from four elements"
    return None


def _empty_range(settings):
    ranges = {f"{part}.x_low and x_high": (settings[part]["x_low"], settings[part]["x_high"]) for part in _RANGES}
    for section in ("indentation", "sizes"):
        ends = settings["ensemble"]["x_low"], settings[section]["until_x"]
        ranges[f"ensemble.x_low and {section}.until_x"] = ends
    ranges |= {f"sizes.windows[{i}]": window for i, window in enumerate(settings["sizes"]["windows"])}
    ranges["media.times.low and high"] = settings["media"]["times"]["low"], settings["media"]["times"]["high"]
    for name, (low, high) in ranges.items():
        if high < 9.99 * low:  # rounded
            return f"{name}: {low} and {high} are less than a decade; allowed: from one decade"
    low, high = settings["scaling"]["stiffness_range"]
    if not low < high:
        return f"scaling.stiffness_range: {low} and {high} are no range; allowed: the first below the second"
    return None


def _too_short_curve(settings):
    end = settings["verdicts"]["plateau_range"][1] * 10 ** settings["scaling"]["slope_half_width"]
    for key, until_x in (
        ("discs.short_until_x", settings["discs"]["short_until_x"]),
        ("indentation.until_x", settings["indentation"]["until_x"]),
    ):
        if until_x < end:
            what = "verdicts.plateau_range and half a slope's width"
            return f"{key}: curves that end at X = {until_x} miss a part of {what}; allowed: from {end:.4g}"
    return None


def _wrong_medium(settings):
    from viscorough.io.media import medium_from_mapping  # takes long to import

    for case in settings["media"]["cases"]:
        try:
            medium_from_mapping({key: value for key, value in case.items() if key != "name"})
        except ValueError as error:
            return f"{case['name']} in media.cases: {error}"
    return None
