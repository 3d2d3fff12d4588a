"""Functions of the study accept every value of every setting with a list of values."""

from collections import defaultdict

import numpy as np
import pytest

from viscorough.io.medium_files import medium_from_mapping
from viscorough.surfaces.self_affine import self_affine_disc, self_affine_line
from viscorough_study.ensembles.measured import measured_indenter
from viscorough_study.fits.conventions import VALUES
from viscorough_study.performance.problems import named_problem
from viscorough_study.run.settings import resolved, schema

MEDIA = {
    "newtonian": {"viscosity": 1e6},
    "maxwell": {"shear_modulus": 2.5e6, "viscosity": 1e6},
    "kelvin_voigt": {"shear_modulus": 2.5e3, "viscosity": 1e6},
    "standard_linear_solid": {"instantaneous_modulus": 2.5e5, "relaxed_modulus": 2.5e4, "relaxation_time": 4.0},
    "prony": {"relaxed_modulus": 2.5e4, "moduli": [1e5, 1e5], "relaxation_times": [0.1, 10.0]},
    "springpot": {"modulus": 4e5, "exponent": 0.5},
}


def use(section, name, value, file):
    """Call the function that a rule calls with this value; file : file with the heights of a scan"""
    if section in ("surface", "variants.cases[]"):
        self_affine_disc(0.5, 17, seed=1, **{name: value})
        if name == "amplitudes":
            self_affine_line(0.5, 64, seed=1, amplitudes=value)
    elif section == "figures":
        assert value in VALUES[name]
    elif section == "media.cases[]":
        medium_from_mapping({name: value} | MEDIA[value])
    elif section == "measured[].preparation":
        measured_indenter(file, spacing=[10.0], unit="um", preparation={name: value})
    else:
        assert section == "methods"
        named_problem(value, 17, 3)


def values_allowed(rule, key=""):
    """Yield (key, value) for every allowed value of settings with a list of values, or with true and false."""
    rule = resolved(rule)
    yield from ((key, value) for value in rule.get("enum", [False, True] if rule.get("type") == "boolean" else []))
    for name, inner in rule.get("properties", {}).items():
        yield from values_allowed(inner, f"{key}.{name}")
    if "items" in rule:
        yield from values_allowed(rule["items"], f"{key}[]")


EVERY = defaultdict(list)
for key, value in values_allowed(schema()):
    EVERY[key.removeprefix(".")].append(value)


@pytest.mark.parametrize("key", EVERY)
def test_function_accepts_every_value(key, tmp_path):
    np.save(tmp_path / "scan.npy", self_affine_disc(0.6, 25, rms=0.5, diameter=250.0, seed=1).heights)
    section, _, name = key.removesuffix("[]").rpartition(".")
    for value in EVERY[key]:
        use(section, name, value, tmp_path / "scan.npy")
