"""The check of the settings, by schema and by sense: one line for the first error."""

import difflib
import math

import jsonschema
import yaml


def whole(_, value):
    return isinstance(value, int) and not isinstance(value, bool)  # JSON would take 3.0


def finite(_, value):
    return (whole(_, value) or isinstance(value, float)) and math.isfinite(value)  # YAML knows .inf and .nan


def check_settings(settings):
    """End with one line that names key, value and what is allowed, unless the settings meet schema and sense."""
    standard = jsonschema.Draft202012Validator
    checker = standard.TYPE_CHECKER.redefine_many({"integer": whole, "number": finite})
    validator = jsonschema.validators.extend(standard, type_checker=checker)
    schema = yaml.safe_load((WORKFLOW / "schemas" / "config.schema.yaml").read_text(encoding="utf-8"))
    error = jsonschema.exceptions.best_match(validator(schema).iter_errors(settings))
    complaint = schema_complaint(error) if error else contradiction(settings)
    if complaint:
        # Not a WorkflowError: Snakemake would add three lines of places in this file to the one about the setting.
        raise SystemExit(f"Error in the settings: {complaint}")


def dotted(path):
    """A key as written in the documentation, such as discs.combinations[0].force."""
    return "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path).lstrip(".") or "settings"


def schema_complaint(error):
    """One line on an error that jsonschema found."""
    key = dotted(error.absolute_path)
    within = f" in {key}" if error.absolute_path else ""
    if error.validator == "additionalProperties":
        known = sorted(error.schema["properties"])
        unknown = sorted(map(str, set(error.instance) - set(known)))[0]
        close = difflib.get_close_matches(unknown, known, 1)
        hint = f"did you mean {close[0]}?" if close else f"allowed: {', '.join(known)}"
        return f"unknown key {unknown}{within}; {hint}"
    if error.validator == "required":
        missing = next(name for name in error.validator_value if name not in error.instance)
        return f"{missing}{within} is missing; needed: {', '.join(error.validator_value)}"
    value = "empty" if error.instance is None else f"{error.instance!r}"[:60]
    hint = ""
    if isinstance(error.instance, str) and "number" in str(error.schema.get("type")):
        hint = "; this is text: numbers are written as 1.0e-3, with a point"
    return f"{key} is {value}; allowed: {allowed(error.schema)}{hint}"


def allowed(rule):
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


def contradiction(settings):
    """One line on settings that are each allowed but do not go together, or None."""
    discs, lines, variants = settings["discs"], settings["lines"], settings["variants"]
    unique = {
        "discs.hurst": discs["hurst"],
        "lines.hurst": lines["hurst"],
        "number in discs.combinations": [each["number"] for each in discs["combinations"]],
        "name in variants.cases": [each["name"] for each in variants["cases"]],
        "validation.elements": settings["validation"]["elements"],
        "methods.hurst": settings["methods"]["hurst"],
        "methods.elements": settings["methods"]["elements"],
        "methods.bodies_elements": settings["methods"]["bodies_elements"],
        "stability.grids": settings["stability"]["grids"],
        **{f"sizes.{key}": settings["sizes"][key] for key in ("hurst", "elements", "points")},
        "sizes.control.hurst": [settings["sizes"]["control"]["hurst"]],
        "large.elements": settings["large"]["elements"],
        "name in methods.tasks": [each["name"] for each in settings["methods"]["tasks"]],
    }
    for key, values in unique.items():
        if twice := [value for value in values if values.count(value) > 1]:
            return f"{key} {twice[0]} stands twice; allowed: each once"
    for key in ("discs.hurst", "lines.hurst", "methods.hurst", "sizes.hurst", "sizes.control.hurst"):
        for hurst in unique[key]:
            if abs(hurst * 1e4 - round(hurst * 1e4)) > 1e-6:
                return f"{key} has {hurst}; allowed: at most four decimals"
    for hurst in discs["hurst"]:
        if hurst not in lines["hurst"]:
            return (
                f"discs.hurst has {hurst}, lines.hurst has not; allowed: exponents of lines.hurst (lambda needs both)"
            )
    for each in discs["combinations"]:
        if not each["rms"] < each["diameter"] / 100:
            where = f"combination {each['number']} of discs.combinations"
            return f"rms {each['rms']} in {where} is too large; allowed: below diameter/100"
    for each in settings["methods"]["tasks"]:
        if each["fractions"][0] > each["fractions"][1]:
            return f"fractions of {each['name']} in methods.tasks decrease; allowed: the first not above the second"
    control = {"name": "sizes.control", "elements": min(settings["sizes"]["elements"]), **settings["sizes"]["control"]}
    for each in [{"name": "surface"}, *variants["cases"], control]:
        surface = {"elements": discs["elements"]} | settings["surface"] | each
        wavelength = surface["roll_off_wavelength"]
        if wavelength is not None and wavelength * surface["elements"] < 4:
            return f"roll_off_wavelength {wavelength} of {each['name']} is too short; allowed: from four elements"
    ranges = {
        "ensemble.x_low and x_high": (settings["ensemble"]["x_low"], settings["ensemble"]["x_high"]),
        "scaling.stiffness_range": settings["scaling"]["stiffness_range"],
    }
    for key, (low, high) in ranges.items():
        if not low < high:
            return f"{key}: {low} and {high} are no range; allowed: the first below the second"
    return None
