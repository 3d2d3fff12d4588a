"""Define rules that involve several settings, such as the order of the ends of a range.

Each rule is a function of the model of the settings (run.settings_model). It yields the contradictions that it finds:
the paths of the settings, such as ["discs", "hurst"], and one line that names these settings and states the allowed
values.
"""

from itertools import chain

from viscorough.surfaces.indenter import LARGEST_ASPECT
from viscorough_study.run.setting_types import shown

# (setting with the lower end, setting with the upper end, smallest allowed ratio of the upper to the lower end)
_RANGES = [
    ("ensemble.x_low", "ensemble.x_high", 10),
    ("reduction.x_low", "reduction.x_high", 10),
    ("periodic.x_low", "periodic.x_high", 10),
    ("media.times.low", "media.times.high", 10),
    ("ensemble.x_low", "indentation.until_x", 10),
    ("ensemble.x_low", "discs.region_until_x", 10),
    ("scaling.stiffness_range.0", "scaling.stiffness_range.1", 1.01),
]


def contradictions(settings):
    """Yield (paths of settings, one line about them) for every contradiction between settings.

    settings : Settings
    """
    return chain.from_iterable(rule(settings) for rule in _RULES)


def name_of(path):
    """Return the name of a setting for messages, such as measured[0].spacing, from its path."""
    return "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path).removeprefix(".")


def _disc_without_line(settings):
    for hurst in settings.discs.hurst:
        if hurst not in settings.lines.hurst:
            complaint = (
                f"discs.hurst has {hurst:g}, lines.hurst has not; allowed: exponents of lines.hurst (lambda needs both)"
            )
            yield [["discs", "hurst"], ["lines", "hurst"]], complaint


def _unlike_lengths(settings):
    for combination in settings.discs.combinations:
        if not combination.diameter * 1e-12 <= combination.rms < combination.diameter / 100:
            place = f"combination {combination.number} of discs.combinations"
            allowed = "below diameter/100, from 1e-12 of it"
            yield [["discs", "combinations"]], f"rms {combination.rms:g} in {place} is out of range; allowed: {allowed}"


def _too_short_wave(settings):
    """Yield contradictions for each roll-off wavelength below four elements, since no grid resolves such waves."""
    across = settings.discs.elements
    every_grid = min(across, settings.lines.points, *settings.discs.coarse.elements)
    waves = [(["surface", "roll_off_wavelength"], every_grid), (["discs", "roll_off", "wavelength"], across)]
    waves += [(["variants", "cases", i, "roll_off_wavelength"], across) for i in range(len(settings.variants.cases))]
    waves.append((["periodic", "roll_off", "wavelength"], settings.periodic.points))
    for path, elements in waves:
        wavelength = _value(settings, path)
        if wavelength is not None and wavelength * elements < 4:
            allowed = f"from {4 / elements:.4g}, four elements of the coarsest grid"
            yield [path], f"{name_of(path)}: {wavelength:g} is too short; allowed: {allowed}"


def _empty_range(settings):
    for low_name, high_name, factor in _RANGES:
        paths = _path(low_name), _path(high_name)
        low, high = (_value(settings, path) for path in paths)
        if high < factor * low * (1 - 1e-9):  # the factor 1 − 1e-9 allows for rounding
            fault = "in the wrong order" if high < low else "too close"
            allowed = f"the second from {factor} times the first"
            yield paths, f"{_range_name(*paths)}: {shown(low)} and {shown(high)} are {fault}; allowed: {allowed}"


def _path(name):
    """Return the path of a setting from its name, such as ["scaling", "stiffness_range", 0]."""
    return [int(key) if key.isdecimal() else key for key in name.split(".")]


def _value(settings, path):
    value = settings
    for key in path:
        value = value[key] if isinstance(key, int) else getattr(value, key)
    return value


def _range_name(low, high):
    """Return the name of a range for messages, from the paths of the settings at its two ends."""
    if low[:-1] != high[:-1]:
        return f"{name_of(low)} and {name_of(high)}"
    return f"{name_of(low)} and {high[-1]}" if isinstance(low[-1], str) else name_of(low[:-1])


def _too_narrow_slope(settings):
    per_decade, path = settings.ensemble.per_decade, ["scaling", "slope_half_width"]
    if (width := settings.scaling.slope_half_width) * per_decade < 1 - 1e-9:
        allowed = f"from 1/per_decade of ensemble, {1 / per_decade:.4g}"
        fault = f"{name_of(path)}: {width:g} decades hold no further abscissa"
        yield [path, ["ensemble", "per_decade"]], f"{fault}; allowed: {allowed}"


def _wrong_medium(settings):
    from viscorough.io.medium_files import medium_from_mapping  # imported here, since the import takes long

    for i, case in enumerate(settings.media.cases):
        try:
            medium_from_mapping(case.model_dump(exclude={"name"}, exclude_unset=True))
        except ValueError as error:
            yield [["media", "cases", i]], f"{case.name} in media.cases: {error}"


def _empty_crop(settings):
    for i, group in enumerate(settings.measured):
        crop = group.preparation.crop if group.preparation else None
        for j, (first, end) in enumerate(crop or []):
            if first >= end:
                path = ["measured", i, "preparation", "crop", j]
                yield [path], f"{name_of(path)}: {first} to {end} is empty; allowed: an end above the first number"


def _unlike_spacings(settings):
    for i, group in enumerate(settings.measured):
        if group.spacing and max(group.spacing) > LARGEST_ASPECT * min(group.spacing):
            path = ["measured", i, "spacing"]
            allowed = f"distances that differ by up to a factor of {LARGEST_ASPECT}"
            yield [path], f"{name_of(path)} is {', '.join(f'{d:g}' for d in group.spacing)}; allowed: {allowed}"


def _unlike_grids(settings):
    """Yield contradictions between the grids of an ensemble, which are listed from coarse to fine."""
    for i, ensemble in enumerate(settings.nested_grids.ensembles):
        path = ["nested_grids", "ensembles", i, "grids"]
        for j, grid in enumerate(ensemble.grids):
            name = f"{name_of([*path, j])}.elements"
            if grid.elements % 2 == 0:
                yield [[*path, j]], f"{name}: {grid.elements} is even; allowed: odd numbers, whose grids share a centre"
            if j and grid.elements <= (before := ensemble.grids[j - 1]).elements:
                yield [path], f"{name}: {grid.elements} comes after {before.elements}; allowed: from coarse to fine"
            if j == len(ensemble.grids) - 1 and grid.surfaces < 20:
                name = f"{name_of([*path, j])}.surfaces"
                yield [[*path, j]], f"{name}: {grid.surfaces} on the finest grid; allowed: at least 20"
            if j and grid.until_x > (before := ensemble.grids[j - 1]).until_x:
                fault = f"{shown(grid.until_x)} is above {shown(before.until_x)} of the next coarser grid"
                yield [path], f"{name_of([*path, j])}.until_x: {fault}; allowed: at most that"


_RULES = (
    _unlike_grids,
    _disc_without_line,
    _unlike_lengths,
    _too_short_wave,
    _empty_range,
    _too_narrow_slope,
    _wrong_medium,
    _empty_crop,
    _unlike_spacings,
)
