"""Types of settings: numbers with limits and a unit, choices, texts and lists.

A type is an annotation of pydantic. It checks a value strictly, so 33.0 is no whole number and "33" no number. It
becomes a part of the JSON schema, with keywords that the standard does not have:

- `unit` of a number, "1" without a unit,
- `decimals`, the largest number of decimals, so that different Hurst exponents have different file names,
- `eachOnce` of a list: true, or the key whose values must differ between its mappings,
- `allowed`, the pattern of a text in words,
- `also`, a requirement in addition to the limits, such as an order of two settings.
"""

from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field
from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import PydanticCustomError


class Section(BaseModel):
    """Base class of mappings of settings, which refuses unknown keys, inf and nan."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, regex_engine="python-re")


def meaning(description, default: Any = ..., *, also=""):
    """Describe a setting.

    description : meaning of the setting; messages quote it up to the first semicolon
    default : value of a setting that may be omitted; other defaults are in config/config.yaml
    also : requirement in addition to the limits of the type, such as an order of two settings
    """
    return Field(default, description=description, json_schema_extra={"also": also} if also else {})


def whole(low, high):
    """Return the type of whole numbers from `low` to `high`."""
    return Annotated[int, Field(ge=low, le=high, json_schema_extra={"unit": "1"})]


def real(low=None, high=None, *, above=None, unit="1", decimals=None):
    """Return the type of numbers from `low`, or above `above`, to `high`, with at most this number of decimals."""
    limited = Annotated[float, Field(ge=low, gt=above, le=high, json_schema_extra={"unit": unit})]
    if decimals is None:
        return limited

    def check(value):
        if value != round(value, decimals):
            raise PydanticCustomError("decimals", "too many decimals")
        return value

    return Annotated[limited, AfterValidator(check), Field(json_schema_extra={"decimals": decimals})]


def text(pattern, allowed):
    """Return the type of texts of a pattern; allowed : the pattern in words"""
    return Annotated[str, Field(pattern=pattern, json_schema_extra={"allowed": allowed})]


def several(item, least, most, *, once=False):
    """Return the type of lists of `least` to `most` items.

    once : whether items must differ, or the key whose values must differ between mappings
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
    """Return a setting as text for messages: 30 for 30.0."""
    if isinstance(value, list):
        return f"[{', '.join(map(shown, value))}]"
    return f"{value:g}" if isinstance(value, float) else str(value)


class Schema(GenerateJsonSchema):
    """Generate a JSON schema without titles, and without a default if an omitted setting has no value."""

    def field_title_should_be_set(self, schema):
        return False

    def model_schema(self, schema):
        return {key: value for key, value in super().model_schema(schema).items() if key != "title"}

    def default_schema(self, schema):
        return self.generate_inner(schema["schema"]) if schema["default"] is None else super().default_schema(schema)

    def nullable_schema(self, schema):
        inner = self.generate_inner(schema["schema"])
        return inner | {"type": [inner["type"], "null"]}
