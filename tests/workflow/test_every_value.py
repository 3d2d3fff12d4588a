"""Every value of every setting with a list of values runs once, at the smallest scale."""

import numpy as np
import pytest

from support.workflow import TEST, merged, read_settings, settings_file, snakemake
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.run.settings import resolved, schema


def scan(name, **preparation):
    entry = {"name": name, "files": ["scan.npy"], "spacing": [10.0], "unit": "um", "forces": [1e-3]}
    return entry | {"preparation": preparation}


# Together with config/test.yaml, these settings use every value.
RUNS = {
    "ensemble": {
        "figures": {"average": "arithmetic", "rms_convention": "ensemble", "window_rule": "kappa", "gamma": "with"},
        "media": {
            "cases": [
                {"name": "newtonian", "kind": "newtonian", "viscosity": 1e6},
                {"name": "maxwell", "kind": "maxwell", "shear_modulus": 2.5e6, "viscosity": 1e6},
                {"name": "kelvin_voigt", "kind": "kelvin_voigt", "shear_modulus": 2.5e3, "viscosity": 1e6},
                {
                    "name": "solid",
                    "kind": "standard_linear_solid",
                    "instantaneous_modulus": 2.5e5,
                    "relaxed_modulus": 2.5e4,
                    "relaxation_time": 4.0,
                },
                {
                    "name": "prony",
                    "kind": "prony",
                    "relaxed_modulus": 2.5e4,
                    "moduli": [1e5, 1e5],
                    "relaxation_times": [0.1, 10.0],
                },
                {"name": "springpot", "kind": "springpot", "modulus": 4e5, "exponent": 0.5},
            ]
        },
        "measured": [
            scan("untouched", detrend="none", fill="none", flip=False),
            scan("centred", detrend="mean", fill="harmonic"),
            scan("flipped", detrend="plane", flip=True),
            scan("ball", detrend="sphere"),
        ],
    },
    "square": {
        "figures": {"rms_convention": "square", "window_rule": "lower_half"},
        "variants": {
            "cases": [
                {"name": "random", "corners": False, "amplitudes": "random", "rms_over": "disc"},
                {"name": "others", "corners": True, "amplitudes": "fixed", "rms_over": "square"},
            ]
        },
        "methods": {"bodies": ["cone", "sphere"]},
    },
    "upper_half": {
        "figures": {"window_rule": "upper_half"},
        "surface": {"corners": True, "amplitudes": "fixed", "rms_over": "square"},
    },
}


def values_allowed(rule, key=""):
    """Yield (key, value) for every allowed value of settings with a list of values, or with true and false."""
    rule = resolved(rule)
    yield from ((key, value) for value in rule.get("enum", [False, True] if rule.get("type") == "boolean" else []))
    for name, inner in rule.get("properties", {}).items():
        yield from values_allowed(inner, f"{key}.{name}")
    if "items" in rule:
        yield from values_allowed(rule["items"], f"{key}[]")


def values_used(rule, settings, key=""):
    """Yield (key, value) of these settings in a file of settings."""
    rule = resolved(rule)
    if "enum" in rule or rule.get("type") == "boolean":
        yield key, settings
    for name, inner in rule.get("properties", {}).items():
        if isinstance(settings, dict) and name in settings:
            yield from values_used(inner, settings[name], f"{key}.{name}")
    for entry in settings if "items" in rule else ():
        yield from values_used(rule["items"], entry, f"{key}[]")


def test_runs_use_every_value():
    small = merged(read_settings("config"), read_settings("test"))
    runs = [small, *(merged(small, changed) for changed in RUNS.values())]
    assert set(values_allowed(schema())) == {value for run in runs for value in values_used(schema(), run)}
    assert len(set(values_allowed(schema()))) > 35


@pytest.mark.parametrize("name", RUNS)
def test_runs_with_every_value_end(finished, name):
    heights = self_affine_disc(0.6, 25, rms=0.5, diameter=250.0, seed=1).heights
    np.save(finished / "scan.npy", heights)
    snakemake(finished, *TEST, settings_file(finished, name, **RUNS[name]))
    assert snakemake(finished, *TEST, f"{name}.yaml", "--dry-run").count("Nothing to be done") == 1
