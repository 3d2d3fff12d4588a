"""Write the JSON schema of the settings and the tables of config/README.md: python docs/write_settings.py

Both come from the model, src/viscorough_study/run/settings_model.py. A comment in the page, `<!-- settings: discs -->`,
names the sections of the table that follows it.
"""

import re
from pathlib import Path

import yaml

from viscorough_study.run.settings import allowed, resolved, schema, unit_of

ROOT = Path(__file__).resolve().parents[1]
SCHEMA, PAGE = ROOT / "workflow/schemas/config.schema.yaml", ROOT / "config/README.md"
HEAD = """\
# JSON schema of the settings, for editors. Written by `python docs/write_settings.py` from the model of the settings,
# src/viscorough_study/run/settings_model.py. The keywords `unit`, `decimals`, `eachOnce`, `allowed` and `also` are not
# in the standard; src/viscorough_study/run/setting_types.py explains them.

"""
TABLE_HEAD = "| key | unit | range | meaning |\n|---|---|---|---|\n"


def schema_text():
    """Return the content of the schema."""
    standard = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return HEAD + yaml.safe_dump(standard | schema(), sort_keys=False, allow_unicode=True, width=120)


def keys(rule, name):
    """Yield (key, its part of the schema) of a setting and of all settings in it; an item of a list is `key[]`."""
    inner = resolved(rule)
    if "properties" in inner:
        for key, part in inner["properties"].items():
            yield from keys(part, f"{name}.{key}")
        return
    yield name, rule
    if "items" in inner and "properties" in resolved(inner["items"]):
        yield from keys(inner["items"], f"{name}[]")


def table(sections):
    """Return the table of all settings of some sections."""
    rows = []
    for section in sections:
        for key, rule in keys(schema()["properties"][section], section):
            limits = "; ".join(filter(None, (allowed(rule), rule.get("also"))))
            default = f"; by default {rule['default']}" if rule.get("default") else ""
            rows.append(f"| `{key}` | {unit_of(rule)} | {limits} | {rule['description']}{default} |\n")
    return TABLE_HEAD + "".join(rows)


def page_text(page):
    """Return the text of the page with new tables after the comments that name their sections."""
    pattern = re.compile(r"(<!-- settings: ([\w ]+) -->\n\n)(?:\|.*\n)*")
    return pattern.sub(lambda match: match[1] + table(match[2].split()), page)


if __name__ == "__main__":
    SCHEMA.write_text(schema_text(), encoding="utf-8")
    PAGE.write_text(page_text(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
