"""Random NetCDF, .npy and TIFF files of known maps of heights, as programs write them; for file_campaign.py."""

import io

import netCDF4
import numpy as np
import tifffile
from file_cases import PIXELS, UNITS, Draft, distances, map_shape, missing_points

SI = ("um", "nm", "mm", "m")


def heights_of(draft, kinds, least=2):
    """Heights of a random type, some of them missing where the type has nan."""
    kind = np.dtype(draft.pick(kinds))
    shape = map_shape(draft, least)
    values = draft.random.normal(0, 30, shape) if kind.kind == "f" else draft.random.integers(1, 100, shape)
    values = values.astype(kind)
    if kind.kind == "f":
        values[missing_points(draft, shape)] = np.nan
    return values


def given(draft):
    """(options, unit of the heights in metres, spacing) where the arguments state the spacing, and a unit or none."""
    dx, dy = distances(draft)
    if draft.chance(0.5):
        return {"spacing": (dx, dy)}, None, (dx, dy)
    unit = draft.one_of(SI)
    draft.note("unit given")
    return {"spacing": (dx, dy), "unit": unit}, UNITS[unit], (dx * UNITS[unit], dy * UNITS[unit])


def npy(random):
    """A .npy file; bad ones hold no map of real, finite numbers."""
    draft = Draft("npy", random)
    values = heights_of(draft, ["f8", "f4", "f2", ">f8", ">f4", "i2", "u2", "i4", ">i4", "i8", "u1"])
    maps = {"C order": np.ascontiguousarray(values), "Fortran order": np.asfortranarray(values)}
    no_maps = {"complex": values + 1j, "bool": values > 0, "text": values.astype("U9"), "one dimension": values.ravel()}
    no_maps |= {"three dimensions": values[None], "pairs": np.zeros(values.shape, "f8,f8")}
    no_maps |= {"infinite": np.where(values == values, np.inf, 0), "all missing": np.full(values.shape, np.nan)}
    file = io.BytesIO()
    np.save(file, draft.pick(maps, bad=no_maps, odd=0.3))
    options, unit, spacing = given(draft)
    return draft.case("map.npy", file.getvalue(), values.astype(float), unit, spacing, options)


# ---- NetCDF

COORDINATES = {"double": ("f8", 0), "single": ("f4", 0), "far": ("f8", 2e6), "far, single": ("f4", 1000)}
NO_MAP = ("irregular", "irregular, far", "repeated", "one coordinate", "degrees", "volts", "no unit of x and y")


def netcdf(random):
    """A NetCDF file with a map, and coordinates or none."""
    draft = Draft("NetCDF", random)
    values = heights_of(draft, ["f8", "f4", "i4", ">f4"], least=3)
    dx, dy = distances(draft)
    u, z = draft.one_of([*SI, "µm", "micron"]), draft.one_of([*SI, "µm", "micrometer"])
    precision, origin = None, 0
    if draft.chance(0.8):
        precision, origin = draft.pick(COORDINATES)
        form = draft.pick(["units", "units", "no units"], ["pixels", "x before y"], NO_MAP, odd=0.25)
    else:
        form = draft.pick(["no coordinates", "no units"])
    z_unit = {"no units": None, "volts": "V"}.get(form, z)
    x_unit = {"no units": None, "no unit of x and y": None, "degrees": "degrees_east"}.get(form, u)
    unit, factor, options = UNITS[z] if z_unit else None, UNITS[u] if z_unit else 1, {}
    if precision is None or form == "pixels":
        x_unit, factor, options = draft.one_of(PIXELS), unit or 1, {"spacing": (dx, dy)}
        if form == "pixels" and draft.chance(0.3):
            draft.note("no spacing", bad=True)
            options = {}
    if form == "no units" and precision and 1.0 in (dx, dy):
        draft.note("may be numbers of points", clear=False)
    axes = list(zip(draft.one_of([("y", "x"), ("row", "col")]), values.shape, (dy, dx), strict=True))
    if form == "x before y":
        axes = [("x", *axes[1][1:]), ("y", *axes[0][1:])]
    file = netCDF4.Dataset("map.nc", "w", memory=0, format=draft.one_of(["NETCDF4", "NETCDF3_CLASSIC"]))
    accuracy = 1e-12
    for number, (name, size, step) in enumerate(axes):
        file.createDimension(name, size)
        if precision is None or (form == "one coordinate" and number == 1):
            continue
        positions = np.arange(size) if form == "pixels" else _positions(draft, form, origin, step, size)
        variable = file.createVariable(name, precision, (name,))
        variable[:] = positions
        if x_unit:
            variable.units = x_unit
        if not draft.bad:
            accuracy += 2 * np.finfo(precision).eps * np.abs(positions).max() / np.ptp(positions)
    heights = _netcdf_heights(draft, file, [name for name, *_ in axes], values, z_unit)
    return draft.case("map.nc", bytes(file.close()), heights, unit, (dx * factor, dy * factor), options, accuracy)


def _positions(draft, form, origin, step, size):
    """Positions along an axis, one in three descending."""
    positions = origin + step * np.arange(size)
    if form == "irregular":
        positions[-1] += 0.7 * step
    elif form == "repeated":
        positions[-1] = positions[-2]
    elif form == "irregular, far":  # by more than single precision rounds them
        positions = 2e6 + 2.0 * np.arange(size) + 0.8 * (-1.0) ** np.arange(size)
    return positions[::-1] if draft.chance(0.3) else positions


def _netcdf_heights(draft, file, names, values, unit):
    """Write the variable of heights; what it holds once unpacked."""
    heights, mask, fill = values.astype(float), np.isnan(values.astype(float)), None
    attributes = {draft.one_of(["units", "units", "units", "unit"]): unit} if unit else {}
    marks = {"_FillValue": -9999.0, "missing_value": 1e20} if values.dtype.kind == "f" else {}
    form = draft.pick({"nan": None, **marks, "packed": "packed"})
    if form == "packed":
        scale, offset = draft.one_of([0.01, 0.5, 1e-3]), draft.one_of([0.0, 100.0])
        values = np.where(mask, -32768, np.round(np.where(mask, 0, heights))).astype("i2")
        heights = np.where(mask, np.nan, values * scale + offset)
        fill, attributes = -32768, attributes | {"scale_factor": scale, "add_offset": offset}
    elif form:
        values = np.where(mask, np.array(form, values.dtype), values)
        fill, attributes = (form, attributes) if form < 0 else (None, attributes | {"missing_value": form})
    name = draft.one_of(["heights", "heights", "z", "elevation", "Band1"])
    variable = file.createVariable(name, values.dtype.newbyteorder("="), names, fill_value=fill)
    variable.set_auto_maskandscale(False)
    variable.setncatts(attributes)
    variable[...] = values if names[0] != "x" else values.T
    return heights


# ---- TIFF


def written(values, **options):
    file = io.BytesIO()
    tifffile.imwrite(file, values, **({"photometric": "minisblack", "metadata": None} | options))
    return file.getvalue()


FORMS = {"plain": {}, "big endian": {"byteorder": ">"}, "big": {"bigtiff": True}, "tiles": {"tile": (16, 16)}}
FORMS |= {"compressed": {"compression": "zlib"}, "72 dpi": {"resolution": (72, 72), "resolutionunit": "INCH"}}
NO_MAPS = {"three colours": {"photometric": "rgb"}, "three pages": {}}


def tiff(random):
    """A TIFF file whose tags state no spacing, but for the resolution of prints."""
    draft = Draft("TIFF", random)
    values = heights_of(draft, ["f4", "f8", "u2", "i2", "u1", "f2"])
    form = draft.pick(FORMS, bad=NO_MAPS, odd=0.24)
    options, unit, spacing = given(draft)
    stored = np.stack([values] * 3, axis=-1 if "photometric" in form else 0) if draft.bad else values
    name = draft.one_of(["map.tif", "map.tiff"])
    return draft.case(name, written(stored, **form), values.astype(float), unit, spacing, options)


LATERAL = {"m": (9001, 1.0), "foot": (9002, 0.3048), "US foot": (9003, 1200 / 3937), "none": None}
VERTICAL = {"z in m": (9001, 1.0), "z in feet": (9002, 0.3048), "z without unit": None}
DEGREES = {
    "geographic": [(1024, 2), (1025, 1), (2048, 4326), (2054, 9102)],
    "no model": [(1025, 1), (2048, 4326)],
    "no model, angular unit": [(1025, 1), (2048, 4326), (2054, 9102)],
    "user-defined": [(1024, 32767), (1025, 1), (2048, 32767), (2054, 9102)],
}


def geotiff(random):
    """A GeoTIFF, as GDAL writes it."""
    draft = Draft("GeoTIFF", random)
    values = heights_of(draft, ["f4", "f8", "i2", "u2"])
    dx, dy = distances(draft)
    lateral, vertical = draft.pick(LATERAL), draft.pick(VERTICAL)
    keys, items, options = [(1025, 1), (1024, draft.one_of([1, 1, 32767]))], [], {}
    if draft.chance(0.3):
        draft.note("datum of a projection")
        keys += [(2048, 4326), (2054, 9102), (3072, 32767)]
    keys += [(4099, vertical[0])] if vertical else []
    keys += [(3076, lateral[0])] if lateral else []
    unit = vertical[1] if vertical else None
    if lateral and not vertical and draft.chance(0.5):
        draft.note("unit given")
        options, unit = {"unit": "m"}, 1.0
    elif bool(lateral) != bool(vertical):
        draft.note("unit of one direction only", bad=True)
    elif not lateral and draft.chance(0.3):
        draft.note("unit type", bad=True)
        items.append('<Item name="UNITTYPE" sample="0" role="unittype">m</Item>')
    if draft.chance(0.12):
        draft.note("degrees", bad=True)
        keys = draft.pick(DEGREES)
    values, heights, tags = _geotiff_heights(draft, values, items)
    form = draft.pick({"pixel scale": None, "transformation": 0}, {}, {"rotated": 0.2}, odd=0.1)
    if form is None:
        tags.append((33550, "d", 3, (dx, dy, 0.0), True))
        tags.append((33922, "d", 6, (0.0, 0.0, 0.0, 5e5, 5.4e6, 0.0), True))
    else:
        matrix = [[dx, form * dx, 0, 5e5], [form * dy, -dy, 0, 5.4e6], [0, 0, 0, 0], [0, 0, 0, 1.0]]
        tags.append((34264, "d", 16, tuple(np.ravel(matrix)), True))
    directory = [1, 1, 0, len(keys), *(number for key, value in sorted(keys) for number in (key, 0, 1, value))]
    tags.append((34735, "H", len(directory), directory, True))
    spacing = (dx * lateral[1], dy * lateral[1]) if lateral else (dx, dy)
    return draft.case("map.tif", written(values, extratags=tags), heights, unit, spacing, options)


def _geotiff_heights(draft, values, items):
    """(values as stored, heights, tags) with points missing, and scaled or not, as GDAL notes it."""
    tags, heights = [], values.astype(float)
    if draft.chance(0.3):
        draft.note("GDAL_NODATA")
        mark = draft.one_of(["65535" if values.dtype.kind == "u" else "-9999", "0", "7"])
        mask = draft.random.random(values.shape) < 0.3
        mask[0, 0] = False
        values = np.where(mask, np.array(float(mark)).astype(values.dtype), values)
        heights = np.where(values == values.dtype.type(float(mark)), np.nan, heights)
        tags.append((42113, "s", 0, mark, True))
    if draft.chance(0.25):
        draft.note("scale and offset", clear=False)
        scale, offset = draft.one_of([(0.01, 0.0), (0.5, -100.0), (1.0, 250.0), (2.0, 0.0)])
        items.append(f'<Item name="OFFSET" sample="0" role="offset">{offset:g}</Item>')
        items.append(f'<Item name="SCALE" sample="0" role="scale">{scale:g}</Item>')
        heights = heights * scale + offset
    elif draft.chance(0.1):
        items.append('<Item name="AREA_OR_POINT">Area</Item>')
    if items:
        tags.append((42112, "s", 0, f"<GDALMetadata>\n  {' '.join(items)}\n</GDALMetadata>\n", True))
    return values, heights, tags


def imagej(random):
    """A TIFF file of ImageJ with its calibration: the unit and resolution of x and y, and sometimes values."""
    draft = Draft("ImageJ", random)
    values = heights_of(draft, ["f4", "u2", "u1"])
    dx, dy = draft.one_of([(0.5, 0.5), (0.25, 0.5), (0.2, 0.2), (2.0, 4.0), (0.125, 0.1)])
    texts = {"um": "um", "\\u00B5m": "um", "micron": "micron", "nm": "nm", "mm": "mm", "cm": "cm", "m": "m"}
    text = draft.pick(texts | {"inch": "inch"}, dict.fromkeys(PIXELS), odd=0.2)
    name = draft.traits[-1]
    metadata, heights = {"unit": name}, values.astype(float)
    z = draft.one_of(SI)
    options, unit = {"unit": z}, UNITS[z]
    factor = (UNITS | {"inch": 0.0254}).get(text, unit)
    spacing = dx * factor, dy * factor
    if text is None:
        options["spacing"] = (dx, dy)
        draft.clear |= name == "pixel"
    elif draft.chance(0.15):
        draft.note("no unit of z", bad=True)
        options = {}
    elif draft.chance(0.15):
        draft.note("calibrated values", clear=False)
        metadata |= {"cf": 0, "c0": 3.0, "c1": 0.25, "vunit": z}
        heights = 3.0 + 0.25 * heights
        options = {} if draft.chance(0.5) else options
    resolution = (1 / dx, 1 / dy) if text else (1.0, 1.0)
    content = written(values, imagej=True, resolution=resolution, metadata=metadata)
    return draft.case("map.tif", content, heights, unit, spacing, options, 1e-6)
