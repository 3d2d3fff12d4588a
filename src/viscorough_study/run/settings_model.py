"""Define the model of the settings: every key with its type, limits, unit and meaning.

`python docs/write_settings.py` writes the JSON schema workflow/schemas/config.schema.yaml and the tables of
config/README.md from this model. Default values are in config/config.yaml; the model itself has values only for keys
that may be omitted. Rules that involve several settings are in run.settings_rules.

X is the dimensionless force F/(4GhL), κ is the dimensionless stiffness k/(4GL), h is the rms height, and L is the
diameter of an indenter or the length of a line.
"""

from typing import Any, Literal

from pydantic import ConfigDict, model_validator
from pydantic_core import PydanticCustomError

from viscorough_study.run.setting_types import Section, meaning, real, several, text, whole
from viscorough_study.run.settings_rules import contradictions

HURST = real(0, 1, decimals=4)
HURST_EXPONENTS = several(HURST, 1, 101, once=True)
FORCE = real(above=0, high=1e12, unit="N")
NAME = text(r"^[a-z][a-z_]{2,30}$(?!\n)", "a-z and _, at least three")
REALIZATIONS = whole(2, 10_000)
BATCH = whole(1, 10_000)
X = real(1e-15, 1e4)
TEN_TIMES = "at least ten times"


class Combination(Section):
    """One combination of force, viscosity, diameter and rms height."""

    number: whole(1, 99) = meaning(
        "number of the combination in file names and seeds; renumbering gives other surfaces, reordering does not"
    )
    force: real(1e-12, 1e9, unit="N") = meaning("constant force F; affects only the time axis in SI units")
    viscosity: real(1e-9, 1e15, unit="Pa s") = meaning(
        "shear viscosity η of the half-space; affects only the time axis in SI units"
    )
    diameter: real(1e-9, 1e3, unit="m") = meaning("diameter L of the indenter")
    rms: real(1e-12, 10, unit="m") = meaning(
        "nominal rms height h; small compared with L, because half-space theory requires small slopes",
        also="from 1e-12 L, below L/100",
    )


PERIOD = real(1, 16, unit="L")
FOUR_ELEMENTS = "at least four elements"


class LongerPeriod(Section):
    """Discs that are cut from a square larger than the disc, with h of the square: a second reading of the paper."""

    period: PERIOD = meaning("period of the square that these discs are cut from")
    realizations: REALIZATIONS = meaning("surfaces per Hurst exponent, all with h = L = 1 m")


class RollOffDiscs(Section):
    """Control discs whose spectrum has no long waves, so that their curves follow no power law."""

    wavelength: real(above=0, high=16, unit="L") = meaning("longest wavelength", also=FOUR_ELEMENTS)
    realizations: REALIZATIONS = meaning("surfaces per Hurst exponent")


class Coarse(Section):
    """Discs on coarse grids, whose means are compared with the means on the grid of `discs.elements`."""

    elements: several(whole(9, 4097), 1, 12, once=True) = meaning("elements across the discs of each grid")
    realizations: REALIZATIONS = meaning("surfaces per Hurst exponent and grid")


class LawDiscs(Section):
    """Discs of Hurst exponents that `discs.hurst` lacks, for the calibrated law."""

    hurst: HURST_EXPONENTS = meaning("Hurst exponents of these discs")
    realizations: REALIZATIONS = meaning("surfaces per Hurst exponent, whose curves go on to `indentation.until_x`")


class Discs(Section):
    """Self-affine discs with lengths in metres, indented by boundary elements."""

    hurst: HURST_EXPONENTS = meaning(
        "Hurst exponents H of the discs", also="each also in `lines.hurst`, since λ(H) needs both"
    )
    elements: whole(9, 4097) = meaning("elements across the diameter; the paper has 257")
    tolerance: real(1e-8, 0.1) = meaning(
        "relative accuracy of the curves of ensembles; it replaces `indentation.tolerance`, since a mean over many "
        "curves needs less accuracy than a single curve "
        "([Ensembles](../docs/verification.md#the-tolerance-of-ensembles))"
    )
    realizations: REALIZATIONS = meaning("surfaces per combination and Hurst exponent; the paper has at least 80")
    whole_curves: whole(1, 10_000) = meaning(
        "number of realizations, the first ones of every combination and variant, whose curves go on to "
        "`indentation.until_x`; beyond `discs.short_until_x` means are over these"
    )
    short_until_x: real(above=0, high=1e4) = meaning(
        "X at which the curves of further realizations end",
    )
    batch: BATCH = meaning(
        "realizations of every combination in a job; at most these are lost when it is killed. A change alters no "
        "result, but all of these curves are computed again"
    )
    longer_period: LongerPeriod
    roll_off: RollOffDiscs
    coarse: Coarse
    law: LawDiscs
    single_batch: BATCH = meaning("realizations per job of the ensembles that have a single combination")
    region_until_x: real(above=0, high=1e4) = meaning(
        "X at which curves end that only the fits in region (b) use", also=f"{TEN_TIMES} `ensemble.x_low`"
    )
    combinations: several(Combination, 1, 99, once="number") = meaning(
        "combinations of force, viscosity, diameter and rms height, as in the paper's Fig. 2; each has its own "
        "surfaces. The nine values are ours, because the paper does not list its own"
    )


AMPLITUDES = Literal["random", "fixed"]
RMS_OVER = Literal["disc", "square"]
ROLL_OFF_WAVELENGTH = real(above=0, high=16, unit="L") | None
ROLL_OFF_LEVEL = real(0, 1)


class Surface(Section):
    """Properties of surfaces that the paper does not state; default values for all ensembles."""

    period: PERIOD = meaning(
        "period of the square that a disc is cut from; 1: the disc spans the period, 2: it is a part of a surface of "
        "longer period"
    )
    corners: bool = meaning("whether the corners of the Fourier square, beyond the Nyquist circle, contain waves")
    amplitudes: AMPLITUDES = meaning(
        "amplitudes of the waves of discs and lines; random: complex Gaussian (a Gaussian process), fixed: the square "
        "root of the spectrum, with random phases"
    )
    rms_over: RMS_OVER = meaning(
        "elements over which the rms height of every realization is the nominal h; the rms heights by every "
        "convention are stored and used in ensembles"
    )
    roll_off_wavelength: ROLL_OFF_WAVELENGTH = meaning(
        "longest wavelength of the power law, of discs and lines; null: no roll-off",
        also=f"{FOUR_ELEMENTS} of the coarsest grid",
    )
    roll_off_level: ROLL_OFF_LEVEL = meaning(
        "spectral density of longer waves relative to that at the roll-off wavelength, of discs and lines; 0: none, "
        "1: a plateau"
    )


class Variant(Section):
    """A variant of the surfaces: a name, and at least one key of `surface` with another value."""

    model_config = ConfigDict(json_schema_extra={"minProperties": 2})

    name: text(
        r"^(?!(base|coarse|law|lines|longer_period|roll_off)$)[a-z][a-z_]{2,30}$(?!\n)",
        "a-z and _, at least three, not `base`, `coarse`, `law`, `lines`, `longer_period`, `roll_off`",
    ) = meaning("name in file names, tables and seeds")
    period: PERIOD = meaning("replaces `surface.period`", None)
    corners: bool = meaning("replaces `surface.corners`", None)
    amplitudes: AMPLITUDES = meaning("replaces `surface.amplitudes`", None)
    rms_over: RMS_OVER = meaning("replaces `surface.rms_over`", None)
    roll_off_wavelength: ROLL_OFF_WAVELENGTH = meaning(
        "replaces `surface.roll_off_wavelength`",
        None,
        also=FOUR_ELEMENTS,
    )
    roll_off_level: ROLL_OFF_LEVEL = meaning("replaces `surface.roll_off_level`", None)

    @model_validator(mode="after")
    def _changes_something(self):
        if self.model_fields_set == {"name"}:
            raise PydanticCustomError("changes nothing", "changes nothing; allowed: a name and a key of surface")
        return self


class Variants(Section):
    """Further ensembles of discs (h = L = 1 m), each with some choices of `surface` changed, for the sensitivities."""

    realizations: REALIZATIONS = meaning("surfaces per variant and Hurst exponent")
    cases: several(Variant, 0, 20, once="name") = meaning("the variants; each has a name and at least one further key")


class Indentation(Section):
    """Loading path of the discs in elastic contact."""

    tolerance: real(1e-8, 0.1) = meaning(
        "relative accuracy of depth, force and stiffness of each level; and of the interpolation between levels"
    )
    until_fraction: real(1e-6, 1) = meaning("share of the elements in contact at which a curve ends")
    until_x: real(1e-14, 1e4) = meaning(
        "X = F/(4GhL) at which a curve ends if it is reached first; h is the larger of the two rms heights",
        also=f"{TEN_TIMES} `ensemble.x_low`",
    )


class Lines(Section):
    """Self-affine lines (h = L = 1 m) for the method of dimensionality reduction."""

    hurst: HURST_EXPONENTS = meaning("Hurst exponents of the lines", also="with all of `discs.hurst`")
    points: whole(256, 2**26) = meaning(
        "points of a line; the paper has 4 000 000. Lines are generated in the job that computes their curves, and "
        "not stored"
    )
    realizations: REALIZATIONS = meaning("lines per Hurst exponent; the paper has 500")
    batch: BATCH = meaning("lines per job")


class Ensemble(Section):
    """Abscissae X common to all curves."""

    x_low: X = meaning("lowest abscissa X = F/(4GhL) = Ft/(4ηhL)")
    x_high: X = meaning("highest abscissa", also=f"{TEN_TIMES} `x_low`")
    per_decade: whole(2, 200) = meaning("abscissae per decade; their decimal logarithms are multiples of 1/per_decade")


class Scaling(Section):
    """Region (b) of a mean curve, the window of the power law, and the bootstrap."""

    elements_min: real(1, 1e6) = meaning(
        "smallest number of elements in contact (median over realizations); below, the discretisation affects the curve"
    )
    stiffness_max: real(above=0, high=1) = meaning(
        "highest κ = k/(4GL); above, the finite size of the indenter affects the curve"
    )
    slope_max: real(above=0, high=1) = meaning("largest local slope; it is 1 in the regions (a) and (c)")
    slope_half_width: real(above=0, high=2, unit="decades") = meaning(
        "half the width of the interval of X over which a local slope is fitted; in narrower ones the slope of some "
        "tens of realizations is dominated by noise",
        also="at least 1/`ensemble.per_decade`",
    )
    fraction_min: real(above=0, high=1) = meaning(
        "smallest share of the realizations whose curve is defined at an abscissa; the mean over fewer is biased"
    )
    decades_min: real(above=0, high=10, unit="decades") = meaning(
        "shortest window; over less than a factor of three in X any smooth curve looks like a power law"
    )
    stiffness_range: several(real(above=0, high=1), 2, 2) = meaning(
        "lower and upper κ of the window `kappa`; the same state of contact on any grid", also="in ascending order"
    )
    resamples: whole(10, 1_000_000) = meaning("bootstrap samples of each fit")


class Interface(Section):
    """The rough interface, in series with the flat punch."""

    plateau: real(above=0, high=0.5) = meaning(
        "share of its maximum by which the contribution of the interface to vt/h is lower at the ends of the plateau"
    )


class RollOff(Section):
    """Roll-off of the second spectrum of the periodic surfaces."""

    wavelength: real(above=0, high=1) = meaning(
        "longest wavelength of the power law over the period; of the second spectrum", also=FOUR_ELEMENTS
    )
    level: real(0, 1) = meaning("spectral density of longer waves relative to that at the roll-off")


class Periodic(Section):
    """Test of the model of two springs: contact of surfaces with the same spectra on a periodic half-space."""

    hurst: HURST_EXPONENTS = meaning("Hurst exponents")
    points: whole(16, 4096) = meaning("elements along a side of the periodic square")
    surfaces: whole(2, 100_000) = meaning("surfaces of each Hurst exponent and spectrum")
    roll_off: RollOff
    x_low: real(1e-15, 1000) = meaning("lowest X = (π/4) p L/(E* h) of the levels")
    x_high: real(1e-15, 1000) = meaning("highest X of the levels", also=f"{TEN_TIMES} `x_low`")
    per_decade: whole(2, 100) = meaning("levels per decade of X")


LIMIT = real(above=0, high=1)


class Limits(Section):
    """Largest allowed relative error on the finest grid, for each quantity."""

    force: LIMIT = meaning("largest relative error of the force on sphere and cone")
    depth: LIMIT = meaning(
        "largest relative error of the depth of sphere and cone; at given impulse or, by the MDR, at given force"
    )
    stiffness: LIMIT = meaning("largest relative error of the stiffness of sphere and cone")
    velocity: LIMIT = meaning(
        "largest relative error of the velocity of sphere and cone; under constant and rising force"
    )
    area: LIMIT = meaning("largest relative error of the contact area of sphere and cone")
    punch_stiffness: LIMIT = meaning("largest relative error of the stiffness of a flat disc and a flat ellipse")
    correspondence: LIMIT = meaning(
        "largest relative error of the depth of a rough disc; the correspondence against direct integration in time, "
        "contact event by event"
    )


class Validation(Section):
    """Comparison with exact solutions."""

    elements: several(whole(17, 1025), 1, 8, once=True) = meaning(
        "elements across the body; three or more grids show the order of convergence"
    )
    order_margin: real(0, 2) = meaning("amount by which an observed order of convergence may be below the expected one")
    limits: Limits


class Direct(Section):
    """Comparison of direct integration in time with both readings of the law, and with the row of springs."""

    elements: whole(9, 257) = meaning("elements across the indenters whose motion is integrated directly in time")
    impulses: whole(2, 10_000) = meaning("impulses ∫F dt/η at which depths are compared, for each indenter")


class Times(Section):
    """Times of the tables of depth and velocity, in a geometric sequence."""

    low: real(1e-30, 1e30, unit="s") = meaning("first time")
    high: real(1e-30, 1e30, unit="s") = meaning("last time", also=f"{TEN_TIMES} `low`")
    per_decade: whole(2, 200) = meaning("times per decade")


POSITIVE = {"above": 0, "high": 1e30}


class MediumCase(Section):
    """A medium: its name, its kind, and the parameters of this kind."""

    name: NAME = meaning("name in tables and figures")
    kind: Literal["newtonian", "maxwell", "kelvin_voigt", "standard_linear_solid", "prony", "springpot"] = meaning(
        "kind of medium"
    )
    viscosity: real(**POSITIVE, unit="Pa s") = meaning("viscosity of `newtonian`, `maxwell`, `kelvin_voigt`", None)
    shear_modulus: real(**POSITIVE, unit="Pa") = meaning("shear modulus of `maxwell`, `kelvin_voigt`", None)
    instantaneous_modulus: real(**POSITIVE, unit="Pa") = meaning(
        "shear modulus of `standard_linear_solid` at t = 0", None
    )
    relaxed_modulus: real(0, 1e30, unit="Pa") = meaning(
        "shear modulus of `standard_linear_solid` and `prony` at t → ∞", None, also="0 for `prony` only"
    )
    relaxation_time: real(**POSITIVE, unit="s") = meaning("relaxation time of `standard_linear_solid`", None)
    moduli: several(real(**POSITIVE, unit="Pa"), 1, 100) = meaning("shear moduli of the branches of `prony`", None)
    relaxation_times: several(real(**POSITIVE, unit="s"), 1, 100) = meaning(
        "relaxation times of the branches of `prony`", None
    )
    modulus: real(**POSITIVE, unit="Pa sᵃ") = meaning("coefficient K of `springpot`; J = tᵃ/(K Γ(1 + a))", None)
    exponent: real(above=0, high=1) = meaning(
        "exponent a of `springpot`", None, also="below 1, where it is `newtonian`"
    )


class Media(Section):
    """Media other than the paper's, into which the discs of the first combination penetrate."""

    force: FORCE = meaning("constant force F, from time 0 on")
    times: Times
    cases: several(MediumCase, 1, 6, once="name") = meaning("the media")


class Preparation(Section):
    """Steps that prepare heights, in the order in which they are applied."""

    nodata: several(real(-1e300, 1e300, unit="unit of the heights"), 0, 10) = meaning(
        "values that mark points that were not measured", None
    )
    crop: several(several(whole(0, 1_000_000), 2, 2), 2, 2) = meaning(
        "first column and end, first row and end, from 0; ends are not included",
        None,
        also="each end above the first number",
    )
    flip: bool = meaning("whether the sign is changed, for data in which larger is lower", None)
    detrend: Literal["none", "mean", "plane", "sphere"] = meaning("surface that is fitted and subtracted", None)
    fill: Literal["none", "harmonic"] = meaning("method that fills enclosed regions without heights", None)


class ScanGroup(Section):
    """A group of scans that are read and prepared alike."""

    name: NAME = meaning("name of the group in tables and file names")
    files: several(text(r"^[^\n]+$", "without line breaks"), 1, 1000) = meaning(
        "files or patterns of files; relative to the folder where the workflow runs"
    )
    spacing: several(real(above=0, high=1e12, unit="unit of the heights"), 0, 2) = meaning(
        "distance between neighbouring columns and rows; one number for both, none if the file states it", []
    )
    unit: text(r"^[^\n]{1,20}$", "a unit of length") = meaning(
        "unit of heights and spacing, if the file states none", None
    )
    preparation: Preparation = meaning("preparation of the heights, in this order", {})
    forces: several(FORCE, 0, 20, once=True) = meaning("constant forces, from time 0 on, for the kinetics", [])
    young_modulus: real(above=0, high=1e15, unit="Pa") = meaning(
        "Young's modulus of an elastic half-space, for a table of contacts under the forces; without it there is none",
        None,
    )
    poisson_ratio: real(above=-1, high=0.5) = meaning("Poisson ratio of the elastic half-space", 0.5)


class Reduction(Section):
    """Comparison of the method of dimensionality reduction with boundary elements, surface by surface."""

    x_low: real(1e-15, 0.1) = meaning("lowest abscissa X at which a line is compared with its disc")
    x_high: X = meaning("highest abscissa", also=f"{TEN_TIMES} `x_low`")
    per_decade: whole(2, 200) = meaning("abscissae per decade")


ROUGH_GRIDS = several(whole(9, 1025), 1, 8, once=True)


class OneSurface(Section):
    """Surfaces on which all models of a single surface are compared."""

    hurst: several(HURST, 2, 4, once=True) = meaning(
        "Hurst exponents of the surfaces on which grids, the MDR and the law are measured; the law "
        "is left out where it is not calibrated"
    )
    elements: whole(65, 2049) = meaning(
        "elements across the full map, to which all are compared; the grids are every second to every sixteenth point "
        "of it"
    )
    surfaces: whole(1, 1000) = meaning("surfaces of each Hurst exponent; errors are root mean squares over them")


class Methods(Section):
    """Comparison of the speed and the accuracy of all methods."""

    hurst: HURST_EXPONENTS = meaning("Hurst exponents of the rough discs")
    elements: ROUGH_GRIDS = meaning(
        "elements across the rough discs; slow methods are measured only up to limits from 65 to 257"
    )
    bodies: several(Literal["sphere", "cone"], 0, 2, once=True) = meaning(
        "bodies of revolution in addition to the rough discs"
    )
    bodies_elements: ROUGH_GRIDS = meaning("elements across the bodies of revolution")
    levels: whole(3, 1000) = meaning("depths at which velocities are compared")
    repeats: whole(1, 100) = meaning("timed repeats, interleaved; their medians are taken")
    longest: real(0.01, 3600, unit="s") = meaning(
        "time from which on a method is neither repeated nor tried at finer values of its parameter"
    )
    one_surface: OneSurface


class Stability(Section):
    """Stress tests, which show where the methods fail."""

    across: whole(9, 65) = meaning(
        "elements across the indenters of all stress-test cases but those that vary the grid"
    )
    grids: several(whole(9, 2049), 1, 8, once=True) = meaning(
        "elements across the discs of the stress-test cases that vary the grid"
    )


class NestedGrid(Section):
    """A grid on which discs are indented, and also on all coarser grids of the list."""

    elements: whole(3, 16385) = meaning("elements across the discs", also="odd")
    surfaces: whole(0, 1_000_000) = meaning(
        "discs that are indented on this grid and on all coarser grids", also="at least 20 on the finest grid"
    )
    until_x: real(1e-6, 1.0) = meaning(
        "X = F/(4GhL) at which the curves end, with h over all waves of the spectrum",
        also="at most the value of the next coarser grid",
    )
    batch: whole(1, 1_000_000) = meaning("discs per job")


class NestedEnsemble(Section):
    """Discs of one Hurst exponent on grids from coarse to fine."""

    hurst: real(above=0, high=1, decimals=4) = meaning("Hurst exponent")
    grids: several(NestedGrid, 2, 12, once="elements") = meaning("grids, from coarse to fine")


class NestedGrids(Section):
    """The same discs on several grids, for β at small X and its limit on finer grids (`make fine-grids`)."""

    elements_min: whole(1, 1_000_000) = meaning(
        "median of the elements in contact from which a curve is used on a grid"
    )
    tolerance: real(1e-6, 0.1) = meaning("tolerance of the curves")
    ensembles: several(NestedEnsemble, 1, 20, once="hurst") = meaning("discs, for every Hurst exponent")


class Settings(Section):
    """Settings of the viscorough workflow."""

    seed: whole(0, 2**64 - 1) = meaning("root seed of every random surface")
    discs: Discs
    surface: Surface
    variants: Variants
    indentation: Indentation
    lines: Lines
    ensemble: Ensemble
    scaling: Scaling
    interface: Interface
    periodic: Periodic
    validation: Validation
    direct: Direct
    media: Media
    measured: several(ScanGroup, 0, 20, once="name") = meaning("groups of scans that are read and prepared alike")
    reduction: Reduction
    methods: Methods
    stability: Stability
    nested_grids: NestedGrids

    @model_validator(mode="after")
    def _agree(self) -> Any:
        """Raise an error for the first contradiction between settings that are valid separately."""
        for paths, complaint in contradictions(self):
            raise PydanticCustomError("contradiction", "{text}", {"text": complaint, "paths": paths})
        return self
