"""Complete the settings of a run with the default settings, and check them.

If settings are wrong, the error message describes the first fault in one line. The model of the settings is in
run.settings_model, and the default values are in config/config.yaml.

`python -m viscorough_study.run.settings > settings.schema.json` writes a JSON schema of settings files, for editors.
"""

import difflib
import json
from pathlib import Path

from pydantic import ValidationError
from snakemake.utils import update_config

from viscorough_study.run.settings_files import read_settings_file
from viscorough_study.run.settings_model import Settings

GIVEN = "the settings of --config or of the module"  # the source of settings that are in no file


def check_settings(settings):
    """Return settings that agree with their model, in the form in which the workflow uses them.

    settings : mapping of all settings
    Whole numbers become floating-point numbers where these are expected, and lists are sorted, so that different
    spellings of the same settings are equal. Raises ValueError, one line with the key, the fault and the value.
    """
    try:
        return Settings.model_validate(settings).model_dump(exclude_unset=True)
    except ValidationError as error:
        # A misspelled key, which also leaves its right spelling missing, comes first.
        faults = sorted(error.errors(include_url=False), key=lambda fault: fault["type"] != "extra_forbidden")
        raise ValueError(_complaint(faults[0], settings)) from None


def complete_settings(defaults, given, files=(), check=check_settings):
    """Complete the settings of a run with the default settings, and return what `check` returns for them.

    defaults : path of the file of the default settings
    given : all settings of this run, from files, from the command line, or from a workflow that uses this workflow as a
        module
    files : paths of settings files. They only serve to name the source of a wrong setting in messages.
    check : function that raises ValueError, one line, for wrong settings
    Raises ValueError, one line that names its source, for a file that cannot be read and for the first wrong setting.
    """
    sources = {path_shown(path): read_settings_file(path) for path in (defaults, *files)} | {GIVEN: given}
    settings = read_settings_file(defaults)
    update_config(settings, given)
    try:
        return check(settings)
    except ValueError:
        settings = {}
        for name, source in sources.items():
            update_config(settings, source)
            try:
                check(settings)
            except ValueError as error:
                raise ValueError(f"{name}: {error}") from None
        raise


def _complaint(fault, settings):
    """Return one line about a fault; fault : entry of pydantic.ValidationError.errors()"""
    *above, key = fault["loc"] or [""]
    message, value = fault["msg"].removeprefix("Value error, "), fault["input"]
    if fault["type"] == "extra_forbidden":
        for part in above:
            settings = settings[part]
        close = difflib.get_close_matches(str(key), [name for name in map(str, settings) if name != key], 1)
        message = "unknown key" + (f"; did you mean {close[0]}?" if close else "")
    elif fault["type"] not in ("missing", "value_error"):
        message += f" (it is {repr(value)[:60]})"
        if fault["type"] in ("float_type", "int_type") and isinstance(value, str):
            message += "; this is text: write numbers as 1.0e-3, with a point"
    return " ".join(": ".join(filter(None, [_name(fault["loc"]), message])).split())


def _name(path):
    """Return the name of a setting for messages, such as measured[0].spacing, from its path."""
    return "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path).removeprefix(".")


def changed_settings(defaults, settings, above=()):
    """Return the settings that differ from the defaults, {name such as "discs.elements": (value, default value)}.

    defaults, settings : mappings of all settings, with the same keys; above : keys of the mapping that contains them
    """
    changed = {}
    for key, value in settings.items():
        default, path = defaults.get(key), (*above, key)
        if isinstance(value, dict) and isinstance(default, dict):
            changed |= changed_settings(default, value, path)
        elif value != default:
            changed[_name(path)] = (value, default)
    return changed


def path_shown(path):
    """Return a path for messages: relative to the working directory if the file lies in it, otherwise unchanged."""
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path)


if __name__ == "__main__":
    print(json.dumps(Settings.model_json_schema(), indent=2))
