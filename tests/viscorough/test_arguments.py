"""Numbers in arguments of public functions: any real type and unit counts as plain floats, all else is refused."""

import dataclasses
import inspect
import itertools
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
import pint
import pytest

import viscorough
from support.contract import refused
from viscorough import reference
from viscorough.mdr import line_of_map, line_of_surface
from viscorough.surfaces.self_affine import cut_disc
from viscorough.viscous.integration.events import newtonian_events

UREG = pint.UnitRegistry()
# Numbers of the calls are sums of few powers of two, so single and half precision hold them exactly.
HEIGHTS = np.array([[0.0, -0.5, -0.25], [-1.0, -0.125, -2.0], [-0.75, -1.5, -0.5]])
DISC = viscorough.Indenter(HEIGHTS, 8.0, length_unit="um")
LINE = viscorough.Indenter(HEIGHTS[0], 8.0, length_unit="um")
CURVE = viscorough.indent(DISC, until_fraction=1.0)
SOLID = viscorough.StandardLinearSolid(2.0**16, 2.0**14, 0.5)
FORCES = [2.0**-24, 2.0**-23]  # N; with moduli of 10 kPa, F/G is some µm²


@dataclasses.dataclass(frozen=True)
class Call:
    """A valid call: arguments with numbers, as values and units (None: no unit), and all other arguments."""

    function: object
    numbers: dict
    others: dict

    def result(self, **changed):
        plain = {name: value for name, (value, _) in self.numbers.items()}
        return self.function(**(plain | self.others | changed))


def call(function, numbers, **others):
    return Call(function, {name: v if isinstance(v, tuple) else (v, None) for name, v in numbers.items()}, others)


OPTIONS = {"threads": 1}
DISC_NUMBERS = {"hurst": 0.5, "elements_across": 5, "rms": 0.5, "diameter": 8.0, "period": 1.5, "seed": 1}
ROLL_OFF = {"roll_off_wavelength": 0.5, "roll_off_level": 0.5}
LENGTH, AREA = "um", "um**2"


def spring_and_dashpot(function):
    """Calls with a modulus in shear and with Young's modulus."""
    modulus, viscosity = (2.0, "Pa"), (4.0, "Pa s")
    return [
        call(function, {"shear_modulus": modulus, "viscosity": viscosity}),
        call(function, {"young_modulus": modulus, "viscosity": viscosity, "poisson": 0.25}),
    ]


CALLS = {
    "indent": [
        call(viscorough.indent, {"depths": ([0.5, 1.0], LENGTH), "tolerance": 0.0625, **OPTIONS}, indenter=DISC),
        call(
            viscorough.indent,
            {"forces": (FORCES, "N"), "shear_modulus": (2.0**14, "Pa"), "tolerance": 0.0625},
            indenter=DISC,
        ),
        call(
            viscorough.indent,
            {"forces": (FORCES, "N"), "young_modulus": (2.0**14, "Pa"), "poisson": 0.25, "tolerance": 0.0625},
            indenter=DISC,
        ),
        call(viscorough.indent, {"forces": ([0.5, 1.0], AREA)}, indenter=DISC),
        call(
            viscorough.indent,
            {"start_fraction": 0.25, "until_fraction": 0.5, "until_force": (4.0, AREA)},
            indenter=DISC,
        ),
    ],
    "contact_at": [
        call(viscorough.contact_at, {"depth": (0.5, LENGTH), "tolerance": 0.0625, **OPTIONS}, indenter=DISC),
        call(
            viscorough.contact_at,
            {"force": (FORCES[0], "N"), "shear_modulus": (2.0**14, "Pa")},
            indenter=DISC,
        ),
        call(
            viscorough.contact_at,
            {"force": (FORCES[0], "N"), "young_modulus": (2.0**14, "Pa"), "poisson": 0.25},
            indenter=DISC,
        ),
    ],
    "SolverOptions": [
        call(
            viscorough.SolverOptions,
            {
                "exact_gap_below": 0.5,
                "operator_rounding": 4.0,
                "max_iterations": 8,
                "dense_contacts": 8,
                "dense_interactions": 8,
                "max_depths": 8,
                "rank_first": 8,
                "rank_all_for_curves": 8,
                "rank_all_share": 0.5,
                "blocks_from": 8,
                "blocks_in_contact": 8,
                "tiles_from": 8,
                "tiles_share": 0.5,
            },
        )
    ],
    "Contact": [
        call(
            viscorough.Contact,
            {
                "pressure": ([[0.5, 0.0]], None),
                "gap": ([[0.0, 1.0]], None),
                "depth": 0.5,
                "force": 0.5,
                "stiffness": 0.5,
                "residual": 0.5,
                "tolerance": 0.5,
                "spacing": 1.0,
                "row_spacing": 1.0,
                "shear_modulus": 2.0,
            },
            contact=np.array([[True, False]]),
        )
    ],
    "LoadingCurve": [
        call(
            viscorough.LoadingCurve,
            {
                "depth": [1.0, 2.0],
                "force": [1.0, 4.0],
                "stiffness": [2.0, 4.0],
                "contact_count": [1.0, 2.0],
                "residual": [0.0, 0.5],
                "elements": 4,
                "tolerance": 0.5,
                "operator_applications": 2,
                "grid_error": [0.5, 0.25],
                "force_grid_error": [0.5, 0.0],
                "area_change": [-0.5, 0.25],
                "mean_grid_error": 0.5,
                "mean_area_change": -0.5,
            },
            method="none",
        )
    ],
    "Load": [
        call(viscorough.Load, {"time": [0.0, 2.0], "force": [1.0, 1.0]}),
        call(viscorough.Load, {"time": [0.0, 2.0], "depth": [1.0, 1.0]}),
    ],
    "Motion": [
        call(
            viscorough.Motion,
            {key: [0.5, 1.0] for key in ("time", "depth", "force", "velocity", "contact_fraction")}
            | {"receding_from": 0.5},
        )
    ],
    "Indenter": [
        call(
            viscorough.Indenter,
            {"heights": (HEIGHTS.tolist(), LENGTH), "spacing": (1.0, LENGTH), "row_spacing": (2.0, LENGTH)},
            length_unit="um",
        ),
        call(viscorough.Indenter, {"spacing": ([1.0, 2.0], LENGTH)}, heights=HEIGHTS, length_unit="um"),
    ],
    "penetration_law": [call(viscorough.penetration_law, {"hurst": 0.5})],
    "estimate": [
        call(
            viscorough.estimate,
            {"hurst": 0.5, "rms": 0.125, "diameter": 1.0, "force": 1.0, "medium": 1.0, "times": [0.03125, 0.0625]},
        )
    ],
    "prepare": [
        call(viscorough.prepare, {"nodata": [-2.0, -9999.0], "crop": [[0, 2], [0, 3]]}, indenter=DISC),
    ],
    "line_of_map": [call(line_of_map, {"seed": 1}, surface=DISC)],
    "line_of_surface": [call(line_of_surface, {"square": HEIGHTS.tolist(), "spacing": 0.5, "seed": 1})],
    "reduce": [call(viscorough.reduce, {"until_fraction": 0.75, "until_force": (0.5, AREA)}, line=LINE)],
    "cut_disc": [call(cut_disc, {"square": HEIGHTS.tolist(), "elements_across": 3})],
    "self_affine_disc": [
        call(viscorough.self_affine_disc, DISC_NUMBERS | ROLL_OFF, length_unit="um"),
    ],
    "self_affine_line": [
        call(
            viscorough.self_affine_line,
            {"hurst": 0.5, "points": 8, "rms": 0.5, "length": 8.0, "seed": 1} | ROLL_OFF,
            length_unit="um",
        )
    ],
    "kinetics": [
        call(
            viscorough.kinetics,
            {"force": (FORCES[0], "N"), "medium": (2.0**14, "Pa s"), "times": ([0.5, 1.0], "s")},
            curve=CURVE,
        ),
        call(viscorough.kinetics, {"force": (FORCES, "N"), "times": ([0.5, 1.0], "s")}, curve=CURVE, medium=SOLID),
        call(
            viscorough.kinetics,
            {"depth": ([0.25, 0.5], LENGTH), "times": ([0.5, 1.0], "s")},
            curve=CURVE,
            medium=SOLID,
        ),
    ],
    "march": [
        call(
            viscorough.march,
            {"medium": (2.0**14, "Pa s"), "until_fraction": 1.0},
            indenter=DISC,
            load=viscorough.Load([0.0, 1.0], force=FORCES),
            method="events",
        )
    ],
    "KelvinVoigt": spring_and_dashpot(viscorough.KelvinVoigt),
    "Maxwell": spring_and_dashpot(viscorough.Maxwell),
    "Newtonian": [call(viscorough.Newtonian, {"viscosity": (4.0, "Pa s")})],
    "Prony": [
        call(
            viscorough.Prony,
            {"relaxed_modulus": (1.0, "Pa"), "moduli": ([1.0, 2.0], "Pa"), "relaxation_times": ([1.0, 4.0], "s")},
        ),
        call(
            viscorough.Prony,
            {"relaxed_young_modulus": (1.0, "Pa"), "young_moduli": ([1.0, 2.0], "Pa"), "poisson": 0.25},
            relaxation_times=[1.0, 4.0],
        ),
    ],
    "Springpot": [
        call(viscorough.Springpot, {"modulus": 2.0, "exponent": 0.5}),
        call(viscorough.Springpot, {"young_modulus": 2.0, "exponent": 0.5, "poisson": 0.25}),
    ],
    "StandardLinearSolid": [
        call(
            viscorough.StandardLinearSolid,
            {"instantaneous_modulus": (4.0, "Pa"), "relaxed_modulus": (1.0, "Pa"), "relaxation_time": (0.5, "s")},
        ),
        call(
            viscorough.StandardLinearSolid,
            {"instantaneous_young_modulus": (4.0, "Pa"), "relaxed_young_modulus": (1.0, "Pa"), "poisson": 0.25},
            relaxation_time=0.5,
        ),
    ],
}
# Arguments without numbers that the calls do not need.
OPTIONAL = {
    *("progress", "options", "precision", "padding", "length_unit", "corners", "amplitudes", "rms_over", "dtype"),
    *("detrend", "fill", "flip", "kind", "scheme", "medium", "method", "load", "estimate_grid_error"),
    *("column_positions", "row_positions", "from_file"),
}
# Public names without numbers among their arguments, and functions of files (test_heights.py covers their numbers).
WITHOUT_NUMBERS = {"AccuracyWarning", "ConvergenceError", "reference", "read_medium"}
WITHOUT_NUMBERS |= {"load_curve", "save", "plot", "read_heights", "read_line", "read_load", "to_dataset"}
# Functions and results that are imported from their modules.
IN_MODULES = {"cut_disc", "line_of_map", "line_of_surface"}
METHODS = {
    "at_force": call(CURVE.at_force, {"force": ([0.5, 1.0], AREA)}),
    "at_depth": call(CURVE.at_depth, {"depth": ([0.5, 1.0], LENGTH)}),
    "normalised": call(CURVE.normalised, {"rms": (0.5, LENGTH), "diameter": (8.0, LENGTH)}),
    "depth_at": call(newtonian_events(DISC).depth_at, {"impulse": [0.5, 1.0]}),
    "event_at": call(newtonian_events(DISC).event_at, {"impulse": [0.5, 1.0]}),
    "law.velocity": call(viscorough.penetration_law(0.5).velocity, {"x": [0.5, 1.0]}),
    "law.depth": call(viscorough.penetration_law(0.5).depth, {"x": [0.5, 1.0]}),
}
LAWS = {
    "PowerLawBody": {"coefficient": 1.0, "exponent": 2.0},
    "cone": {"slope": 0.5},
    "depth_law": {"x": [0.5, 1.0], "zeta": 0.5, "alpha": 0.5},
    "exponent_alpha": {"hurst": 0.5},
    "exponent_beta": {"hurst": [0.5, 1.0]},
    "flat_disc_stiffness": {"radius": 1.0},
    "flat_ellipse_stiffness": {"major": 2.0, "minor": 1.0},
    "line_spectrum": {"wavenumber": [0.5, 1.0], "spectrum": 1.0, "transfer": 3.0},
    "one_element_stiffness": {"elements_across": 11},
    "rate_law": {"x": 1.0, "hurst": 0.5},
    "sphere": {"radius": 1.0},
    "velocity_law": {"x": [0.5, 1.0], "zeta": 0.5, "alpha": 0.5},
    "zeta_elastic": {"hurst": 0.5},
    "zeta_viscous": {"hurst": 0.5},
}
# Functions in which nan is an unknown number.
FORMULAS = [getattr(reference, name) for name in ("depth_law", "exponent_alpha", "exponent_beta", "line_spectrum")]
FORMULAS += [getattr(reference, name) for name in ("rate_law", "velocity_law", "zeta_elastic", "zeta_viscous")]
ALL = {f"{name}_{i}": each for name, calls in CALLS.items() for i, each in enumerate(calls)} | METHODS
ALL |= {f"reference.{name}": call(getattr(reference, name), numbers) for name, numbers in LAWS.items()}
CASES = [pytest.param(each, name, id=f"{key}-{name}") for key, each in ALL.items() for name in each.numbers]


def assert_same(one, other):
    """Require that two results hold the same numbers, up to the rounding of units."""
    if dataclasses.is_dataclass(one):
        assert type(one) is type(other)
        for field in dataclasses.fields(one):
            assert_same(getattr(one, field.name), getattr(other, field.name))
    elif isinstance(one, list | tuple):
        for a, b in zip(one, other, strict=True):
            assert_same(a, b)
    elif isinstance(one, dict):
        assert_same(list(one.items()), list(other.items()))
    elif isinstance(one, str | None):
        assert one == other
    else:
        np.testing.assert_allclose(np.asarray(one, float), np.asarray(other, float), rtol=1e-9, atol=1e-15)


def one_line(error):
    assert len(str(error).splitlines()) == 1, str(error)
    assert len(str(error)) < 600


def test_every_public_function_and_its_numbers_are_covered():
    assert set(CALLS) == set(viscorough.__all__) - WITHOUT_NUMBERS | IN_MODULES
    for name, calls in CALLS.items():
        covered = set().union(*({*each.numbers, *each.others} for each in calls))
        assert set(inspect.signature(calls[0].function).parameters) - covered <= OPTIONAL, name
    laws = {n for n, value in vars(reference).items() if getattr(value, "__module__", "") == reference.__name__}
    assert set(LAWS) == {name for name in laws if not name.startswith("_")} | {"one_element_stiffness"}
    for name, numbers in LAWS.items():
        assert set(inspect.signature(getattr(reference, name)).parameters) - set(numbers) <= {"gamma"}, name


SAME = {"load": "force", "forces": "force", "depths": "depth", "time": "times"}


@pytest.mark.parametrize("kind", [inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY])
def test_functions_have_their_common_arguments_in_one_order(kind):
    first = {}
    for name in viscorough.__all__:
        if inspect.isfunction(function := getattr(viscorough, name)):
            parameters = inspect.signature(function).parameters.values()
            arguments = [SAME.get(each.name, each.name) for each in parameters if each.kind == kind]
            first |= dict.fromkeys(itertools.combinations(arguments, 2), name)
    assert not {(pair, name, first[pair[::-1]]) for pair, name in first.items() if pair[::-1] in first}


@pytest.mark.parametrize(("each", "name"), CASES)
def test_arguments_take_numbers_of_other_types(each, name):
    """Arrays keep half precision, and lists keep whole numbers and fractions, unless the argument is converted."""
    expected, value = each.result(), each.numbers[name][0]
    whole = np.array(value).dtype.kind == "i"
    typed = np.array(value, dtype=np.uint64 if whole else np.float16)
    assert_same(each.result(**{name: typed if typed.ndim else typed[()]}), expected)
    if not whole:
        objects = np.array([Fraction(number) for number in np.ravel(value)], dtype=object).reshape(np.shape(value))
        assert_same(each.result(**{name: objects if objects.ndim else objects[()]}), expected)


@pytest.mark.parametrize(("each", "name"), CASES)
def test_arguments_refuse_complex_numbers_and_nan_in_one_line(each, name):
    """tests/viscorough/basics/test_arrays.py tries everything else that is no real number."""
    value = each.numbers[name][0]
    for wrong in (1j,) if nan_is_allowed(each, name) else (1j, np.nan):
        for given in [wrong, [value[0], wrong, *value[2:]]] if isinstance(value, list) else [wrong]:
            with pytest.raises((ValueError, TypeError)) as error:
                each.result(**{name: given})
            one_line(error.value)


def nan_is_allowed(each, name):
    """Return True if nan has a meaning for this argument."""
    # Points outside a map, marks of missing points, and forces beyond a curve.
    may_be_nan = {"nodata", "heights", "pressure", "gap"}
    # A formula of nan is nan. A motion has nan where the curve is undetermined.
    at_curve = each in (METHODS["at_force"], METHODS["at_depth"])
    return name in may_be_nan or at_curve or each.function in (*FORMULAS, viscorough.Motion)


@pytest.mark.parametrize(("each", "name"), [case for case in CASES if case.values[0].numbers[case.values[1]][1]])
def test_quantities_with_a_unit_are_converted(each, name):
    expected, (value, unit) = each.result(), each.numbers[name]
    quantity = UREG.Quantity(np.array(value) if isinstance(value, list) else value, unit)
    given = [quantity, quantity.to_base_units()]
    given += [quantity.to(f"milli{UREG.Unit(unit):~}")] if unit in ("N", "s", "Pa") else []
    given += [list(quantity)] if isinstance(value, list) and np.ndim(value) == 1 else []
    for each_given in given:
        if unit == AREA and each.function is viscorough.indent:
            with refused("a force needs"):
                each.result(**{name: each_given})
        else:
            assert_same(each.result(**{name: each_given}), expected)


@pytest.mark.parametrize(
    ("each", "name"), [case for case in CASES if case.values[0].numbers[case.values[1]][1] is None]
)
def test_quantities_are_refused_for_numbers_without_a_unit(each, name):
    value = each.numbers[name][0]
    for unit in ("mN", "ms", "um", "percent"):
        with pytest.raises((ValueError, TypeError), match=r"^[^\n]*$"):
            each.result(**{name: UREG.Quantity(np.array(value) if isinstance(value, list) else value, unit)})


INDENTERS = [name for name, calls in CALLS.items() if {"indenter", "line", "surface", "curve"} & set(calls[0].others)]


NO_INDENTERS = ["heights.npy", Path("curve.nc"), None, 3.0, DISC, LINE, CURVE]


@pytest.mark.parametrize(
    ("name", "wrong"), [(INDENTERS[0], wrong) for wrong in NO_INDENTERS] + [(name, HEIGHTS) for name in INDENTERS]
)
def test_paths_and_arrays_are_refused_as_indenters_and_curves(name, wrong):
    each = CALLS[name][0]
    (argument,) = {"indenter", "line", "surface", "curve"} & set(each.others)
    if wrong is each.others[argument]:
        return
    with pytest.raises((TypeError, ValueError), match=name) as error:
        each.result(**{argument: wrong})
    one_line(error.value)


WITH_MEDIUM = [name for name, calls in CALLS.items() if "medium" in calls[0].others | calls[0].numbers]
NO_MEDIA = [[1.0], np.array([1.0, 2.0]), None, True, 1j, CURVE, 10**400]


@pytest.mark.parametrize(
    ("name", "wrong"), [(WITH_MEDIUM[0], wrong) for wrong in NO_MEDIA] + [(name, "abc") for name in WITH_MEDIUM]
)
def test_wrong_media_are_refused(name, wrong):
    with pytest.raises((TypeError, ValueError)) as error:
        CALLS[name][0].result(medium=wrong)
    one_line(error.value)


@pytest.mark.parametrize("options", [{}, {"precision": "double"}, 1e-3, "single"], ids=repr)
@pytest.mark.parametrize("name", ["indent", "contact_at"])
def test_wrong_types_of_options_are_refused(name, options):
    with pytest.raises(TypeError, match="SolverOptions"):
        CALLS[name][0].result(options=options)


def test_infinite_force_means_that_no_force_ends_the_curve():
    indent = partial(viscorough.indent, DISC, until_fraction=0.5)
    assert indent(until_force=np.float32(np.inf)) == indent(until_force=float("inf")) == indent()
