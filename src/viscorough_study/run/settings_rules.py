"""Define rules that involve several settings, such as the order of the ends of a range.

Each rule is a function of the model of the settings (run.settings_model). It yields the contradictions that it finds:
the paths of the settings, such as ["discs", "hurst"], and one line that names these settings and states the allowed
values.
"""

from itertools import chain

from viscorough_study.run.setting_types import shown

# (setting with the lower end, setting with the upper end, smallest allowed ratio of the upper to the lower end)
_RANGES = [
    ("ensemble.x_low", "ensemble.x_high", 10),
    ("reduction.x_low", "reduction.x_high", 10),
    ("periodic.x_low", "periodic.x_high", 10),
    ("media.times.low", "media.times.high", 10),
    ("ensemble.x_low", "indentation.until_x", 10),
    ("ensemble.x_low", "sizes.until_x", 10),
    ("ensemble.x_low", "verdicts.plateau_range.0", 1),
    ("verdicts.plateau_range.0", "verdicts.plateau_range.1", 10),
    ("verdicts.plateau_range.1", "ensemble.x_high", 1),
    ("scaling.stiffness_range.0", "scaling.stiffness_range.1", 1.01),
]
# Lists of ranges: {setting with a list of upper ends: setting with the lower end of all ranges}. The lower end is None
# if each entry of the list is a pair (lower end, upper end). In each range the ends must differ by a factor of ten.
_RANGES_IN_LISTS = {
    "sizes.windows": None,
    "collapse.x_high": "ensemble.x_low",
    "collapse.corrected_x_high": "ensemble.x_low",
}


def contradictions(settings):
    """Yield (paths of settings, one line about them) for every contradiction between settings.

    settings : Settings
    """
    return chain.from_iterable(rule(settings) for rule in _RULES)


def name_of(path):
    """Return the name of a setting for messages, such as sizes.windows[0], from its path."""
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
    shared, across = settings.surface.roll_off_wavelength, settings.discs.elements
    waves = [(["surface", "roll_off_wavelength"], "surface", shared, across)]
    for i, case in enumerate(settings.variants.cases):
        if "roll_off_wavelength" in case.model_fields_set:
            waves.append((["variants", "cases", i], case.name, case.roll_off_wavelength, across))
    coarsest = min(grid.elements for grid in settings.sizes.discs)
    waves.append((["sizes", "control"], "sizes.control", settings.sizes.control.roll_off_wavelength, coarsest))
    for path, name, wavelength, elements in waves:
        if wavelength is not None and wavelength * elements < 4:
            complaint = f"roll_off_wavelength {wavelength:g} of {name} is too short; allowed: from four elements"
            yield [path], complaint


def _empty_range(settings):
    ranges = list(_RANGES)
    for name, low in _RANGES_IN_LISTS.items():
        entries = [f"{name}.{i}" for i in range(len(_value(settings, _path(name))))]
        ranges += [(low, entry, 10) if low else (f"{entry}.0", f"{entry}.1", 10) for entry in entries]
    for low_name, high_name, factor in ranges:
        paths = _path(low_name), _path(high_name)
        low, high = (_value(settings, path) for path in paths)
        if high < factor * low * (1 - 1e-9):  # the factor 1 − 1e-9 allows for rounding
            fault = "in the wrong order" if high < low else "too close"
            allowed = f"the second from {factor} times the first"
            yield paths, f"{_range_name(*paths)}: {shown(low)} and {shown(high)} are {fault}; allowed: {allowed}"


def _path(name):
    """Return the path of a setting from its name, such as ["sizes", "windows", 0] from "sizes.windows.0"."""
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
    half_width, per_decade = settings.scaling.slope_half_width, settings.ensemble.per_decade
    if half_width * per_decade < 1 - 1e-9:
        fault = f"scaling.slope_half_width: {half_width:g} decades hold no further abscissa"
        allowed = f"from 1/per_decade of ensemble, {1 / per_decade:.4g}"
        yield [["scaling", "slope_half_width"], ["ensemble", "per_decade"]], f"{fault}; allowed: {allowed}"


def _too_short_curve(settings):
    end = settings.verdicts.plateau_range[1] * 10**settings.scaling.slope_half_width
    for path in (["discs", "short_until_x"], ["indentation", "until_x"]):
        if (until_x := _value(settings, path)) < end:
            fault = (
                f"{name_of(path)}: curves that end at X = {until_x:g} miss a part of verdicts.plateau_range and half "
            )
            complaint = f"{fault}a slope's width; allowed: from {end:.4g}"
            yield [path, ["verdicts", "plateau_range", 1]], complaint


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


_RULES = (
    _disc_without_line,
    _unlike_lengths,
    _too_short_wave,
    _empty_range,
    _too_narrow_slope,
    _too_short_curve,
    _wrong_medium,
    _empty_crop,
)
