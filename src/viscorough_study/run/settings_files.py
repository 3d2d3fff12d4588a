"""Reading of settings files, with errors in one line that name file and line.

    python -m viscorough_study.run.settings_files mine.yaml

checks that files can be read. Snakemake itself reads the files given with --configfile before it reads the Snakefile,
and its errors name neither file nor line.
"""

import sys
from pathlib import Path

import yaml

from viscorough.io.atomic import check_readable
from viscorough.io.unique_keys import UniqueKeys
from viscorough_study.run.settings import SettingsError


def read_settings_file(path):
    """The mapping in a file. Raises SettingsError with one line that names the file and, where possible, the line."""
    try:
        check_readable(path)
    except ValueError as error:
        raise SettingsError(str(error)) from None
    try:
        text = Path(path).read_bytes().decode("utf-8-sig")
        settings = yaml.load(text, UniqueKeys)
    except OSError as error:
        raise SettingsError(f"{path}: not readable ({error.strerror})") from None
    except UnicodeDecodeError as error:
        raise SettingsError(f"{path}: byte {error.start + 1} is not UTF-8 text; allowed: YAML in UTF-8") from None
    except (yaml.YAMLError, ValueError) as error:
        raise SettingsError(f"{path}{_place(error)}: not valid YAML") from None
    if not isinstance(settings, dict):
        raise SettingsError(f"{path}: holds no settings; allowed: keys with values")
    return settings


def _place(error):
    """Position and reason of an error in YAML, as text."""
    mark = getattr(error, "problem_mark", None)
    why = " ".join(str(getattr(error, "problem", None) or getattr(error, "reason", "")).split())
    return (f", line {mark.line + 1}, column {mark.column + 1}" if mark else "") + (f": {why}" if why else "")


def main(paths):
    try:
        for path in paths:
            read_settings_file(path)
    except SettingsError as error:
        sys.stderr.write(f"Error in the settings: {error}\n")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
