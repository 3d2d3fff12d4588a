"""Define the model of the settings: the type and the limits of every key, and the rules between keys.

config/config.yaml has the default values and says what every key means. A rule between keys is here only if a job would
fail without it. Lists of which the order does not matter are sorted, so that their order changes no job.

X is the dimensionless force F/(4GhL), κ is the dimensionless stiffness k/(4GL), h is the rms height, and L is the
diameter of an indenter or the length of a line.
"""

from itertools import pairwise
from operator import attrgetter
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from viscorough.basics.units import length_unit
from viscorough.io.medium_files import medium_from_mapping
from viscorough.media.kinds import KINDS
from viscorough.surfaces.indenter import LARGEST_ASPECT


class Item(BaseModel):
    """Base class of mappings in lists, which are given as a whole; unknown keys, inf and nan are errors."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


class Section(Item):
    """Base class of sections. In the JSON schema no key is required, since a file may give only some keys."""

    model_config = ConfigDict(json_schema_extra=lambda schema: schema.pop("required", None))


def whole(low, high):
    """Return the type of whole numbers from `low` to `high`."""
    return Annotated[int, Field(ge=low, le=high)]


def real(low=None, high=None, *, above=None):
    """Return the type of numbers from `low` to `high`, or of numbers above `above` up to `high`."""
    return Annotated[float, Field(ge=low, gt=above, le=high)]


def several(item, least, most, key=None):
    """Return the type of lists of `least` to `most` different items, which are sorted.

    item : type of the items; key : for mappings, the name of the key whose values must differ
    """

    def check(items):
        value_of = attrgetter(key) if key else lambda item: item
        items = sorted(items, key=value_of)
        if twice := [value_of(one) for one, other in pairwise(items) if value_of(one) == value_of(other)]:
            raise ValueError(f"{key or 'the value'} {twice[0]} occurs twice")
        return items

    return Annotated[list[item], Field(min_length=least, max_length=most), AfterValidator(check)]


def _without_braces(value):
    if set(value) & set("{}\n"):
        raise ValueError(f"{value!r} has a brace or a line break, which Snakemake cannot read; rename the file")
    return value


def _four_decimals(value):
    if value != round(value, 4):
        raise ValueError("at most four decimals are allowed, as in the names of files")
    return value


HURST = Annotated[real(0, 1), AfterValidator(_four_decimals)]
HURST_EXPONENTS = several(HURST, 1, 101)
FORCE = real(above=0, high=1e12)
NAME = Annotated[str, Field(pattern=r"^[a-z][a-z_]{2,30}$")]
REALIZATIONS = whole(2, 10_000)
BATCH = whole(1, 10_000)
TOLERANCE = real(1e-8, 0.1)
X = real(1e-15, 1e4)


def _decade(low, high, names):
    """Raise ValueError unless there is a decade between two settings; names : such as "x_low and x_high"."""
    if high < 10 * low * (1 - 1e-9):  # the factor 1 − 1e-9 allows for rounding
        raise ValueError(f"{names}: {low:g} and {high:g}; the second must be at least ten times the first")


class Combination(Item):
    """One combination of force [N], viscosity [Pa s], diameter and rms height [m]."""

    number: whole(1, 99)
    force: real(1e-12, 1e9)
    viscosity: real(1e-9, 1e15)
    diameter: real(1e-9, 1e3)
    rms: real(1e-12, 10)


PERIOD = real(1, 16)
WAVELENGTH = real(above=0, high=16)


class LongerPeriod(Section):
    """Discs that are cut from a square larger than the disc, with h of the square: a second reading of the paper."""

    period: PERIOD
    realizations: REALIZATIONS


class RollOffDiscs(Section):
    """Control discs whose spectrum has no long waves, so that their curves follow no power law."""

    wavelength: WAVELENGTH
    realizations: REALIZATIONS


class Coarse(Section):
    """Discs on coarse grids, whose means are compared with the means on the grid of `discs.elements`."""

    elements: several(whole(9, 4097), 1, 12)
    realizations: REALIZATIONS


class LawDiscs(Section):
    """Discs of further Hurst exponents, for the calibrated law."""

    hurst: HURST_EXPONENTS
    realizations: REALIZATIONS


class Surface(Section):
    """Properties of surfaces that the paper does not state; default values for all ensembles."""

    period: PERIOD
    corners: bool
    amplitudes: Literal["random", "fixed"]
    rms_over: Literal["disc", "square"]
    roll_off_wavelength: WAVELENGTH | None
    roll_off_level: real(0, 1)


class Variant(Item):
    """A variant of the surfaces: a name, and at least one key of `surface` with another value."""

    name: NAME
    period: PERIOD = None
    corners: bool = None
    amplitudes: Literal["random", "fixed"] = None
    rms_over: Literal["disc", "square"] = None
    roll_off_wavelength: WAVELENGTH | None = None
    roll_off_level: real(0, 1) = None

    @model_validator(mode="after")
    def _check(self):
        if self.name in (taken := ("base", "coarse", "law", "lines", "longer_period", "roll_off")):
            raise ValueError(f"the names {', '.join(taken)} are taken")
        if self.model_fields_set == {"name"}:
            raise ValueError("it changes nothing; a key of `surface` is needed")
        return self


class Variants(Section):
    """Further ensembles of discs (h = L = 1 m), each with some properties of `surface` changed."""

    realizations: REALIZATIONS
    surfaces: several(Variant, 0, 20, "name")


class Discs(Section):
    """Self-affine discs, indented by boundary elements."""

    elements: whole(9, 4097)
    realizations: REALIZATIONS
    batch: BATCH
    combinations: several(Combination, 1, 99, "number")
    single_batch: BATCH
    longer_period: LongerPeriod
    roll_off: RollOffDiscs
    coarse: Coarse
    law: LawDiscs
    variants: Variants


class Curves(Section):
    """Loading curves: their ends, their accuracy, and the abscissae of their means."""

    whole: whole(1, 10_000)
    until_x: X
    short_until_x: X
    region_until_x: X
    tolerance: TOLERANCE
    measured_tolerance: TOLERANCE
    x_low: X
    per_decade: whole(2, 200)

    @model_validator(mode="after")
    def _check(self):
        for name in ("until_x", "short_until_x", "region_until_x"):
            _decade(self.x_low, getattr(self, name), f"x_low and {name}")
        return self


class Lines(Section):
    """Self-affine lines (h = L = 1 m) for the method of dimensionality reduction."""

    hurst_step: Annotated[real(1e-2, 1), AfterValidator(_four_decimals)] | None
    points: whole(256, 2**26)
    realizations: REALIZATIONS
    batch: BATCH


class Scaling(Section):
    """Region (b) of a mean curve, the window of the power law, and the bootstrap."""

    elements_min: whole(1, 1_000_000)
    stiffness_max: real(above=0, high=1)
    slope_max: real(above=0, high=1)
    slope_half_width: real(above=0, high=2)
    fraction_min: real(above=0, high=1)
    decades_min: real(above=0, high=10)
    stiffness_range: Annotated[list[real(above=0, high=1)], Field(min_length=2, max_length=2)]
    resamples: whole(10, 1_000_000)

    @model_validator(mode="after")
    def _check(self):
        low, high = self.stiffness_range
        if low >= high:
            raise ValueError(f"stiffness_range: {low:g} and {high:g}; the second must be above the first")
        return self


class RollOff(Section):
    """Roll-off of the second spectrum of the periodic surfaces."""

    wavelength: real(above=0, high=1)
    level: real(0, 1)


class Periodic(Section):
    """Contact of surfaces with the same spectra on a periodic half-space."""

    points: whole(16, 4096)
    surfaces: whole(2, 100_000)
    roll_off: RollOff
    x_low: real(1e-15, 1000)
    x_high: real(1e-15, 1000)
    per_decade: whole(2, 100)

    @model_validator(mode="after")
    def _check(self):
        _decade(self.x_low, self.x_high, "x_low and x_high")
        return self


class Reduction(Section):
    """Comparison of the method of dimensionality reduction with boundary elements, surface by surface."""

    x_low: real(1e-15, 0.1)
    x_high: X
    per_decade: whole(2, 200)

    @model_validator(mode="after")
    def _check(self):
        _decade(self.x_low, self.x_high, "x_low and x_high")
        return self


class Beyond(Section):
    """What goes beyond the paper."""

    plateau: real(above=0, high=0.5)
    periodic: Periodic
    reduction: Reduction


LIMIT = real(above=0, high=1)


class Limits(Section):
    """Largest allowed relative error on the finest grid, for each quantity."""

    force: LIMIT
    depth: LIMIT
    stiffness: LIMIT
    velocity: LIMIT
    area: LIMIT
    punch_stiffness: LIMIT
    correspondence: LIMIT


class Direct(Section):
    """Comparison of direct integration in time with both readings of the law."""

    elements: whole(9, 257)
    impulses: whole(2, 10_000)


class Validation(Section):
    """Comparison with exact solutions, and with direct integration."""

    elements: several(whole(17, 1025), 1, 8)
    order_margin: real(0, 2)
    limits: Limits
    direct: Direct


class Times(Section):
    """Times of the tables of depth and velocity [s], in a geometric sequence."""

    low: real(1e-30, 1e30)
    high: real(1e-30, 1e30)
    per_decade: whole(2, 200)

    @model_validator(mode="after")
    def _check(self):
        _decade(self.low, self.high, "low and high")
        return self


class Medium(Item):
    """A medium: its name, its kind, and the parameters of this kind."""

    model_config = ConfigDict(extra="allow")

    name: NAME
    kind: str

    @model_validator(mode="after")
    def _check(self):
        medium_from_mapping(self.model_dump(exclude={"name"}))
        return self


def _in_order_of_kinds(media):
    return sorted(media, key=lambda medium: list(KINDS).index(medium.kind))


class Kinetics(Section):
    """Motion of the discs in other media, under a constant force [N] from time 0 on."""

    force: FORCE
    times: Times
    media: Annotated[several(Medium, 1, 6, "name"), AfterValidator(_in_order_of_kinds)]


class Preparation(Item):
    """Steps that prepare heights, in the order in which they are applied."""

    nodata: several(real(-1e300, 1e300), 0, 10) = None
    crop: Annotated[
        list[Annotated[list[whole(0, 1_000_000)], Field(min_length=2, max_length=2)]],
        Field(min_length=2, max_length=2),
    ] = None
    flip: bool = None
    detrend: Literal["none", "mean", "plane", "sphere"] = None
    fill: Literal["none", "harmonic"] = None

    @model_validator(mode="after")
    def _check(self):
        for first, end in self.crop or []:
            if first >= end:
                raise ValueError(f"crop: {first} to {end} is empty; the end must be above the first number")
        return self


class ScanGroup(Item):
    """A group of scans that are read and prepared alike."""

    name: NAME
    files: several(Annotated[str, AfterValidator(_without_braces)], 1, 1000)
    spacing: Annotated[list[real(above=0, high=1e12)], Field(max_length=2)] = []
    unit: Annotated[str, AfterValidator(length_unit)] = None
    preparation: Preparation = {}
    forces: several(FORCE, 0, 20) = []
    young_modulus: real(above=0, high=1e15) = None
    poisson_ratio: real(above=-1, high=0.5) = 0.5

    @model_validator(mode="after")
    def _check(self):
        if self.spacing and max(self.spacing) > LARGEST_ASPECT * min(self.spacing):
            raise ValueError(f"spacing: the distances must differ by at most a factor of {LARGEST_ASPECT}")
        return self


ROUGH_GRIDS = several(whole(9, 1025), 1, 8)


class OneSurface(Section):
    """Surfaces on which all models of a single surface are compared."""

    elements: whole(65, 2049)
    surfaces: whole(1, 1000)


class Stress(Section):
    """Stress tests, which show where the methods fail."""

    across: whole(9, 65)
    grids: several(whole(9, 2049), 1, 8)


class Methods(Section):
    """Comparison of the speed, the accuracy and the limits of all methods."""

    elements: ROUGH_GRIDS
    bodies: several(Literal["sphere", "cone"], 0, 2)
    bodies_elements: ROUGH_GRIDS
    levels: whole(3, 1000)
    repeats: whole(1, 100)
    longest: real(0.01, 3600)
    one_surface: OneSurface
    stress: Stress


class FineGrid(Item):
    """A grid on which discs are indented, and also on all coarser grids of the list."""

    elements: Annotated[whole(3, 16385), Field(json_schema_extra={"not": {"multipleOf": 2}})]
    surfaces: whole(0, 1_000_000)
    until_x: real(1e-6, 1.0)
    batch: whole(1, 1_000_000)


class FineEnsemble(Item):
    """Discs of one Hurst exponent on several grids."""

    hurst: Annotated[real(above=0, high=1), AfterValidator(_four_decimals)]
    grids: several(FineGrid, 2, 12, "elements")

    @model_validator(mode="after")
    def _check(self):
        for grid in self.grids:
            if grid.elements % 2 == 0:
                raise ValueError(f"grids: {grid.elements} elements; odd numbers are needed, whose grids share a centre")
        for coarse, fine in pairwise(self.grids):
            if fine.until_x > coarse.until_x:
                places = f"{fine.until_x:g} on the grid of {fine.elements}, {coarse.until_x:g} on the next coarser one"
                raise ValueError(f"grids: until_x is {places}; it must not rise")
        if self.grids[-1].surfaces < 20:
            raise ValueError(f"grids: {self.grids[-1].surfaces} surfaces on the finest grid; at least 20 are needed")
        return self


class FineGrids(Section):
    """The same discs on several grids, for β at small X and its limit on finer grids (`make fine-grids`)."""

    elements_min: whole(1, 1_000_000)
    ensembles: several(FineEnsemble, 0, 20, "hurst")


class Settings(Section):
    """Settings of the viscorough workflow."""

    seed: whole(0, 2**64 - 1)
    hurst: HURST_EXPONENTS
    discs: Discs
    surface: Surface
    curves: Curves
    lines: Lines
    scaling: Scaling
    beyond: Beyond
    validation: Validation
    kinetics: Kinetics
    measured: several(ScanGroup, 0, 20, "name")
    methods: Methods
    fine_grids: FineGrids

    @model_validator(mode="after")
    def _check(self) -> Any:
        width, per_decade = self.scaling.slope_half_width, self.curves.per_decade
        if width * per_decade < 1 - 1e-9:
            raise ValueError(
                f"scaling.slope_half_width: {width:g} decades hold no further abscissa; at least 1/curves.per_decade, "
                f"{1 / per_decade:.4g}, is needed"
            )
        across, periodic = self.discs.elements, self.beyond.periodic
        coarsest = min(across, self.lines.points, *self.discs.coarse.elements)
        variants = [(f"discs.variants, {v.name}", v.roll_off_wavelength, across) for v in self.discs.variants.surfaces]
        for name, wavelength, elements in (
            ("surface.roll_off_wavelength", self.surface.roll_off_wavelength, coarsest),
            ("discs.roll_off.wavelength", self.discs.roll_off.wavelength, across),
            ("beyond.periodic.roll_off.wavelength", periodic.roll_off.wavelength, periodic.points),
            *variants,
        ):
            if wavelength is not None and wavelength * elements < 4:
                raise ValueError(
                    f"{name}: {wavelength:g} is too short; at least {4 / elements:.4g}, four elements of the coarsest "
                    "grid, is needed"
                )
        return self
