"""Define types of settings: numbers with limits and a unit, choices, texts and lists.

A type is an annotation of pydantic. It checks values strictly: 33.0 is no whole number, and "33" is no number. It also
becomes a part of the JSON schema, with keywords that the JSON Schema standard does not have:

- `unit` of a number, "1" for a number without a unit,
- `decimals`, the largest number of decimals of a number; a Hurst exponent has at most as many decimals as file names
  can hold, so different exponents have different file names,
- `eachOnce` of a list: true if its items must differ, or, for a list of mappings, a key whose values must differ,
- `allowed`, a description in words of the pattern of a text,
- `also`, a requirement in addition to the limits, such as an order of two settings.
"""

from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field
from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import PydanticCustomError


class Section(BaseModel):
    """Base class of sections, which are mappings of settings; unknown keys, inf and nan are errors."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, regex_engine="python-re")


def meaning(description, default: Any = ..., *, also=""):
    """Return the pydantic field of a setting, with its meaning, default value and requirements.

    description : meaning of the setting; messages quote it up to the first semicolon
    default : value if the setting is omitted. Only settings that may be omitted have a default here; the values of all
        others are in config/config.yaml.
    also : requirement in addition to the limits of the type, such as an order of two settings
    """
    return Field(default, description=description, json_schema_extra={"also": also} if also else {})


def whole(low, high):
    """Return a setting type that accepts whole numbers from `low` to `high`."""
    return Annotated[int, Field(ge=low, le=high, json_schema_extra={"unit": "1"})]


def real(low=None, high=None, *, above=None, unit="1", decimals=None):
    """Return a setting type that accepts numbers from `low` to `high`, or numbers above `above` up to `high`.

    decimals : largest number of decimals that is accepted; None for no limit
    """
    limited = Annotated[float, Field(ge=low, gt=above, le=high, json_schema_extra={"unit": unit})]
    if decimals is None:
        return limited

    def check(value):
        if value != round(value, decimals):
            raise PydanticCustomError("decimals", "too many decimals")
        return value

    return Annotated[limited, AfterValidator(check), Field(json_schema_extra={"decimals": decimals})]


def text(pattern, allowed):
    """Return a setting type that accepts texts that match `pattern`; allowed : the pattern in words, for messages"""
    return Annotated[str, Field(pattern=pattern, json_schema_extra={"allowed": allowed})]


def several(item, least, most, *, once=False):
    """Return a setting type that accepts lists of `least` to `most` items.

    item : type of the items
    once : True if all items must differ, False if items may be equal. For mappings as items, `once` may be a key whose
        values must differ.
    """
    items = Annotated[list[item], Field(min_length=least, max_length=most)]
    if not once:
        return items

    def check(entries):
        values = [getattr(entry, once) for entry in entries] if isinstance(once, str) else entries
        for value in (value for value in values if values.count(value) > 1):
            name = f"{once} " if isinstance(once, str) else ""
            raise PydanticCustomError("twice", "{text}", {"text": f"{name}{shown(value)} occurs twice; allowed: once"})
        return entries

    return Annotated[items, AfterValidator(check), Field(json_schema_extra={"eachOnce": once})]


def shown(value):
    """Return the value of a setting as text for messages, such as "30" for 30.0."""
    if isinstance(value, list):
        return f"[{', '.join(map(shown, value))}]"
    return f"{value:g}" if isinstance(value, float) else str(value)


class Schema(GenerateJsonSchema):
    """Generator of the JSON schema of the settings; it omits titles, and default values that are None."""

    def field_title_should_be_set(self, schema):
        return False

    def model_schema(self, schema):
        return {key: value for key, value in super().model_schema(schema).items() if key != "title"}

    def default_schema(self, schema):
        return self.generate_inner(schema["schema"]) if schema["default"] is None else super().default_schema(schema)

    def nullable_schema(self, schema):
        inner = self.generate_inner(schema["schema"])
        return inner | {"type": [inner["type"], "null"]}
