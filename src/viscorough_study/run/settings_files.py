"""Read settings files; an error message is one line that names the file and, if possible, the line in it."""

import re
from pathlib import Path

import yaml

from viscorough.io.refusals import reading
from viscorough.io.unique_keys import UniqueKeys


class _SettingsLoader(UniqueKeys):
    """Refuse numbers that begin with a zero: YAML reads them as octal, and 0123 would silently be 83."""

    def construct_yaml_int(self, node):
        if re.fullmatch(r"[-+]?0[0-9_]+", node.value):
            message = f"{node.value} begins with a zero, which makes it octal; write it without the zero"
            raise yaml.constructor.ConstructorError(None, None, message, node.start_mark)
        return super().construct_yaml_int(node)


_SettingsLoader.add_constructor("tag:yaml.org,2002:int", _SettingsLoader.construct_yaml_int)


def read_settings_file(path):
    """Return the mapping in a settings file.

    Raises a one-line ValueError that names the file and, if possible, the line.
    """
    with reading(path, "a mapping of YAML in UTF-8 is needed"):
        settings = yaml.load(Path(path).read_bytes().decode("utf-8-sig"), _SettingsLoader)
        if not isinstance(settings, dict):
            raise ValueError("it holds no settings")
    return settings
