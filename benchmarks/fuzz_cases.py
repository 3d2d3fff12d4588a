"""Random command lines and the files that they name, most of them bad; strategies of hypothesis for fuzz.py."""

import contextlib
import io

import fuzz_surfaces
import netCDF4
import numpy as np
from hypothesis import strategies as st
from hypothesis.extra import numpy as array_strategies

from viscorough.io.curves import curve_to_content
from viscorough.io.motion import with_motion
from viscorough.io.unpacking import STORAGE
from viscorough.loading_curve import LoadingCurve

STARTED = "code-was-run"  # the file that code in a file would make

# ---- values


class Payload:
    """Makes a file when it is unpickled."""

    def __reduce__(self):
        return open, (STARTED, "w")


EXTREME = [0.0, -0.0, -1.0, np.nan, np.inf, -np.inf, 5e-324, 1e-300, 1e300, 1.7e308, -1.7e308, 2.0**53 + 2]
NUMBER_TYPES = ["f8", "f4", "f2", ">f8", ">f4", "g", "i1", "u1", "i2", ">i4", "i8", "u8"]
OTHER_TYPES = ["?", "c16", "U3", "S2", "M8[s]", "m8[s]", "V4", "f8,i4"]
SHAPES = array_strategies.array_shapes(min_dims=2, max_dims=2, max_side=7)
ANY_SHAPE = array_strategies.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4)
TEXTS = st.text(max_size=8) | st.sampled_from(["m", "um", "1", "1e-6 m", "heights", "true", "9", "nan", "é"])
PLAIN = st.floats(-100, 100) | st.integers(-9, 9).map(float)


@st.composite
def arrays(draw, shapes=SHAPES):
    """Arrays of heights: rough, terraced, constant; with extreme entries; of any type."""
    kind = np.dtype(draw(st.sampled_from([*["f8"] * 20, *NUMBER_TYPES, *OTHER_TYPES])))
    shape = draw(shapes)
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    values = random.choice([random.standard_normal(shape), random.integers(0, 4, shape), np.zeros(shape)])
    values = np.array(values * draw(st.sampled_from([1.0, 1.0, 1.0, 1e-2, 1e-9, 1e100, 1e307, 1e-300])))
    for _ in range(draw(st.sampled_from([0, 0, 0, 1, 2])) if values.size else 0):
        values.flat[draw(st.integers(0, values.size - 1))] = draw(st.sampled_from(EXTREME))
    if draw(st.integers(0, 3)) == 0 and values.size:
        values[random.random(shape) < 0.3] = np.nan
    with np.errstate(all="ignore"):
        try:
            return values.astype(kind)
        except (TypeError, ValueError):
            return np.zeros(shape, kind)


@st.composite
def damaged(draw, content):
    """Bytes with a fault: cut, changed, repeated, replaced; most of them without."""
    whole = bytearray(draw(content))
    fault = draw(st.sampled_from([*[None] * 12, "cut", "bits", "zeros", "tail", "none", "random", "double"]))
    place = draw(st.integers(0, max(len(whole) - 1, 0)))
    if fault == "cut":
        return bytes(whole[:place])
    if fault == "bits" and whole:
        for _ in range(draw(st.integers(1, 4))):
            whole[draw(st.integers(0, len(whole) - 1))] ^= 1 << draw(st.integers(0, 7))
    if fault == "zeros":
        whole[place : place + 64] = bytes(len(whole[place : place + 64]))
    made = {
        "none": b"",
        "random": draw(st.binary(max_size=200)),
        "double": bytes(whole) * 2,
        "tail": bytes(whole) + b"x",
    }
    return made.get(fault, bytes(whole))


# ---- files


def npy_bytes(array, **options):
    file = io.BytesIO()
    np.lib.format.write_array(file, np.asarray(array), **options)
    return file.getvalue()


PICKLED = npy_bytes(np.array([[Payload(), 1.0]], dtype=object), allow_pickle=True)
CALL = f"open('{STARTED}', 'w')"
CODE = [
    b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text
    for text in (
        CALL.encode(),
        f"{{'descr': {CALL}, 'fortran_order': False, 'shape': (2, 2), }}".encode(),
        b"{'descr': '<f8', 'fortran_order': False, 'shape': (10000000000, 10000000), }",
        b"{'descr': '<f8', 'fortran_order': False, 'shape': (-1, 2), }",
        b"(" * 4000,
    )
]


def npy_files(shapes=SHAPES):
    return st.one_of(*[damaged(arrays(shapes).map(npy_bytes))] * 6, st.sampled_from([PICKLED, *CODE]))


@contextlib.contextmanager
def in_memory(form="NETCDF4"):
    """Context of a netCDF4.Dataset in memory and a bytearray that gets its bytes."""
    content = bytearray()
    file = netCDF4.Dataset("new.nc", "w", format=form, memory=4096)
    yield file, content
    content += file.close()


ATTRIBUTES = st.one_of(
    TEXTS,
    st.sampled_from([*EXTREME, "", "nan", b"\xff", ["a", "b"], 3, np.int8(-1), np.float32(1e20), np.uint64(2**63)]),
    st.lists(PLAIN, max_size=3).map(np.array),
)
ATTRIBUTE_NAMES = [*STORAGE, "units", "units", "long_name", "Conventions", "elements", "method", "title", "é"]


def some_attributes(draw, most=3):
    names = draw(st.lists(st.sampled_from(ATTRIBUTE_NAMES), max_size=most, unique=True))
    return {name: draw(ATTRIBUTES) for name in names}


def add_attributes(place, attributes):
    """Add those attributes that the NetCDF library accepts."""
    for name, value in attributes.items():
        with contextlib.suppress(Exception):
            place.setncattr(name, value)


@st.composite
def netcdf_heights(draw):
    """NetCDF files with zero to two maps, packed or not, in any of the formats."""
    form = draw(st.sampled_from(["NETCDF4", "NETCDF4", "NETCDF4_CLASSIC", "NETCDF3_CLASSIC", "NETCDF3_64BIT_DATA"]))
    with in_memory(form) as (file, content):
        for name in draw(st.lists(st.sampled_from(["heights", "z", "λ"]), min_size=1, max_size=2, unique=True)):
            values = draw(arrays(SHAPES if draw(st.integers(0, 5)) else ANY_SHAPE))
            with contextlib.suppress(Exception):  # types, fill values and names that the format lacks
                add_variable(draw, file, name, values)
        add_attributes(file, some_attributes(draw))
    return bytes(content)


def add_variable(draw, file, name, values):
    dimensions = [f"{name}{axis}" for axis in range(values.ndim)]
    for dimension, size in zip(dimensions, values.shape, strict=True):
        file.createDimension(dimension, size if draw(st.integers(0, 9)) else None)
    fill = draw(st.sampled_from([None, None, None, values.dtype.type(1)]))
    kind, endian = (
        str if values.dtype.kind == "U" else values.dtype,
        "big" if values.dtype.byteorder == ">" else "native",
    )
    variable = file.createVariable(name, kind, dimensions, fill_value=fill, endian=endian)
    variable.set_auto_maskandscale(False)
    add_attributes(variable, some_attributes(draw, most=draw(st.sampled_from([0, 0, 3]))))
    if draw(st.integers(0, 9)):
        variable[...] = values.astype(object) if values.dtype.kind == "U" else values


def convex_force(depth, stiffness):
    """Forces of a curve whose slope between two levels is the mean of the stiffnesses there."""
    mean = 0.5 * (np.append(0, stiffness[:-1]) + stiffness)
    return np.cumsum(mean * np.diff(depth, prepend=0))


@st.composite
def curve_files(draw):
    """Files of loading curves, some with motion; with variables and attributes changed, added or removed."""
    levels = draw(st.integers(1, 6))
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    depth, stiffness = np.cumsum(random.random((2, levels)) + 0.1, axis=1)
    depth, stiffness = np.array([depth, stiffness]) * draw(st.sampled_from([1.0, 1e-6, 1e150, 1e-160]))
    force = convex_force(depth, stiffness)
    count, residual = np.arange(1, levels + 1), 1e-3 * random.random(levels)
    about = levels + 9, "boundary elements", 1e-3, 5, residual, draw(st.sampled_from(["1", "m", "um"]))
    content = curve_to_content(LoadingCurve(depth, force, stiffness, count, *about))
    if draw(st.booleans()):
        content = with_motion(content, depth, force)
    variables = {
        name: [dims, values.copy(), dict(attributes)] for name, (dims, values, attributes) in content.variables.items()
    }
    for _ in range(draw(st.sampled_from([0, 0, 1, 1, 2]))):
        name = draw(st.sampled_from(sorted(variables)))
        change = draw(st.sampled_from(["entry", "type", "attributes", "missing", "added", "units"]))
        if change == "entry":
            with contextlib.suppress(IndexError, OverflowError, ValueError):
                variables[name][1][draw(st.integers(0, levels - 1))] = draw(st.sampled_from(EXTREME))
        elif change == "type":
            with np.errstate(all="ignore"):
                kind = draw(st.sampled_from(["S3", "i4", "f4", "u1"]))
                variables[name][1] = np.nan_to_num(variables[name][1]).astype(kind)
        elif change == "attributes":
            variables[name][2].update(some_attributes(draw))
        elif change == "units":
            variables[name][2].pop("units", None)
        elif change == "added":
            values = draw(arrays(ANY_SHAPE))
            variables["added"] = [tuple(f"d{axis}" for axis in range(values.ndim)), values, some_attributes(draw)]
        elif len(variables) > 1:
            del variables[name]
    attributes = dict(content.attributes) | (some_attributes(draw) if draw(st.integers(0, 2)) == 0 else {})
    return curve_bytes(variables, attributes)


def curve_bytes(variables, attributes):
    with in_memory() as (file, content):
        for name, (dimensions, values, own) in variables.items():
            with contextlib.suppress(Exception), np.errstate(all="ignore"):
                for dimension, size in zip(dimensions, values.shape, strict=True):
                    if dimension not in file.dimensions:
                        file.createDimension(dimension, size)
                fill = own.pop("_FillValue", None)
                values = values.astype(values.dtype.newbyteorder("="))
                variable = file.createVariable(name, values.dtype, dimensions, fill_value=fill)
                variable.set_auto_maskandscale(False)
                add_attributes(variable, own)
                variable[...] = values
        add_attributes(file, attributes)
    return bytes(content)


@st.composite
def curve_tables(draw):
    """Tables of loading curves, as the command line writes them; some with another column."""
    levels = draw(st.integers(1, 4))
    depth, stiffness = np.cumsum(np.random.default_rng(draw(st.integers(0, 2**32))).random((2, levels)) + 0.1, axis=1)
    headings = ["depth (um),force (um2),stiffness (um),", "depth [m],force [m2],stiffness [m],"]
    headings += ["depth,force,stiffness,", "depth (um),force (nm2),stiffness (um),", "a,b,c,"]
    numbers = np.array([depth, convex_force(depth, stiffness), stiffness]).T.tolist()
    rows = [",".join(map(repr, [*row, i + 1, 5e-4])) for i, row in enumerate(numbers)]
    about = ["# elements: 9", "# operator_applications: 0", "# tolerance: 0.001", '# method: "made up"']
    return "\n".join([*about, f"{draw(st.sampled_from(headings))}contact_count,residual", *rows, ""]).encode()


FIELDS = st.one_of(
    st.integers(0, 9).map(str),
    st.floats(0, 1e3).map(repr),
    st.sampled_from(["nan", "inf", "-1", "1e400", "", "time", "1N", "0x1", "1_0", "٣", "#", '"1"', "\ufeff", "\x00"]),
)
ROWS = st.lists(st.lists(FIELDS, min_size=1, max_size=3).map(",".join), max_size=5)
FORCES = st.lists(st.integers(0, 5), min_size=2, max_size=5)
GOOD = FORCES.map(lambda forces: [f"{time},{force}" for time, force in enumerate(forces)])

POSITIVE = st.sampled_from(["1", "2.5", "1e6", "3e-4", "0.5", "7"])
ODD_VALUES = st.sampled_from(
    [
        *["0", "-1", ".nan", ".inf", "1e400", "[1, 2]", "{a: 1}", "true", "null", "'1 Pa'", "2 MPa", "x", "''", "*a"],
        f"!!python/object/apply:open ['{STARTED}', w]",
    ]
)
PARAMETERS = {
    "newtonian": ["viscosity"],
    "maxwell": ["shear_modulus", "viscosity"],
    "kelvin_voigt": ["shear_modulus", "viscosity"],
    "standard_linear_solid": ["instantaneous_modulus", "relaxed_modulus", "relaxation_time"],
    "prony": ["relaxed_modulus", "moduli", "relaxation_times"],
    "springpot": ["modulus", "exponent"],
    "creep_table": ["file"],
}


@st.composite
def media(draw):
    """YAML files of media, most of them right; with values changed, keys missing, repeated or unknown."""
    kind = draw(st.sampled_from(sorted(PARAMETERS)))
    entries = [("kind", kind)]
    branches = draw(st.integers(1, 4))
    for name in PARAMETERS[kind]:
        values = POSITIVE
        if name in ("moduli", "relaxation_times"):
            values = st.lists(POSITIVE, min_size=branches, max_size=branches).map(lambda texts: f"[{', '.join(texts)}]")
        elif name == "file":
            values = st.sampled_from(["table.csv"] * 6 + ["none.csv", "folder", "../table.csv", "medium.yaml", ""])
        elif name == "exponent":
            values = st.sampled_from(["0.2", "0.5", "0.9"])
        elif name == "instantaneous_modulus":
            values = st.sampled_from(["1e7", "8"])
        entries.append((name, draw(ODD_VALUES if draw(st.integers(0, 9)) == 0 else values)))
    for _ in range(draw(st.sampled_from([0, 0, 0, 0, 0, 1]))):
        change = draw(st.sampled_from(["missing", "repeated", "unknown", "kind"]))
        entry = draw(st.integers(0, len(entries) - 1))
        if change == "missing":
            del entries[entry]
        elif change == "kind":
            entries[0] = ("kind", draw(st.sampled_from(["rubber", "[maxwell]", "1", "Prony"])))
        else:
            entries.append(entries[entry] if change == "repeated" else (draw(TEXTS), draw(POSITIVE)))
    return "\n".join(f"{name}: {value}" for name, value in entries).encode(errors="replace")


# Creep that slows down, with steps of time of 1.
TABLES = st.lists(st.floats(0, 1), min_size=2, max_size=6).map(
    lambda steps: "\n".join(
        f"{time},{float(value)!r}" for time, value in enumerate(np.cumsum(sorted(steps, reverse=True)))
    )
)
TABLES = damaged(st.one_of(TABLES, TABLES, ROWS.map("\n".join)).map(str.encode))
STEPS = GOOD.map(lambda rows: [*rows, f"{len(rows) - 1},9", f"{len(rows)},9"])  # a step at the last time
HEADINGS = ["t,F", "t [ms],F [mN]", "# t/h,F in kN", "F [N],t [s]", "t (x),F", "# in ms", "#N/A,1", "t;F"]
HEADED = st.tuples(st.sampled_from(HEADINGS), GOOD).map(lambda parts: [parts[0], *parts[1]])
HISTORIES = damaged(st.one_of(GOOD, HEADED, STEPS, ROWS).map("\n".join).map(str.encode))

# ---- options

NUMBERS = st.one_of(
    *[st.floats(1e-3, 10).map(repr)] * 6,
    st.floats().map(repr),
    st.sampled_from([*map(repr, EXTREME), "", "a", "1e400", "1e-400", "1_0", "0x1", "１", " 1 ", "1,5", "--help", "-"]),
)
SERIES = st.one_of(
    *[
        st.lists(st.floats(1e-3, 5), min_size=1, max_size=4, unique=True)
        .map(sorted)
        .map(lambda x: ",".join(map(repr, x)))
    ]
    * 3,
    st.lists(NUMBERS, max_size=3).map(",".join),
)
SHARES = st.sampled_from(["0.5", "0.9", "1", "0.01"]) | NUMBERS
OUTPUTS = (
    ["out.nc"] * 24
    + ["out.csv"] * 6
    + [
        *["", ".", "/", "none/out.nc", "folder", "folder/out.nc", "out", "-", "a\nb.nc", "é.nc", "x" * 300, "pipe"],
        *["heights.npy", "heights.nc", "force.csv", "curve.nc", "link.nc", "dangling.nc", "older.nc", "\udcff.nc"],
    ]
)
FIGURES = [*["out.png"] * 12, "out.svg", "out.nc", "out", "none/out.png", "folder", "pipe", "curve.nc", "é.png"]
WHOLE = st.sampled_from(["3", "9", "64", "0", "-1", "1.5", "99999999", "", "nan"])
METHODS = [*["events", "explicit", "heun", "implicit", "second_order"] * 4, "magic", ""]
QUANTITIES = st.one_of(
    NUMBERS, st.sampled_from(["1 N", "5 mN", "2 MPa", "3 um", "1e-3 m", "1 kg", "2 ", "1 N,2", "1 mN,2 mN"])
)
CONSTANTS = {
    "--shear-modulus": QUANTITIES,
    "--young": QUANTITIES,
    "--poisson": st.sampled_from(["0.3", "0.5"]) | NUMBERS,
}
OPTIONS = {
    "indent": {
        "--tolerance": SHARES,
        "--until-fraction": SHARES,
        "--depths": SERIES | QUANTITIES,
        "--forces": SERIES | QUANTITIES,
        "--until-force": QUANTITIES,
        "--threads": WHOLE,
        **CONSTANTS,
        **fuzz_surfaces.OPTIONS,
    },
    "contact": {
        "--tolerance": SHARES,
        "--force": SERIES | QUANTITIES,
        "--depth": SERIES | QUANTITIES,
        "--threads": WHOLE,
        **CONSTANTS,
    },
    "kinetics": {  # these exclude those that it has, repeat them or name other files
        "--force": NUMBERS,
        "--viscosity": NUMBERS,
        "--force-history": st.sampled_from(["force.csv", "force.npy", "older.nc", "none.csv", "folder", "pipe"]),
        "--medium": st.sampled_from(["medium.yaml", "older.nc", "none.yaml", "folder", "pipe"]),
    },
    "march": {
        "--force": NUMBERS,
        "--viscosity": NUMBERS,
        "--times": SERIES,
        "--overlap": SHARES,
        "--until-fraction": SHARES,
        "--force-history": st.sampled_from(["force.csv", "force.npy", "older.nc", "none.csv", "folder"]),
    },
    "reduce": {"--until-fraction": SHARES, "--realizations": st.sampled_from(["2", "5", "0", "a"]), "--seed": WHOLE}
    | fuzz_surfaces.OPTIONS,
    "plot": {"--spacing": NUMBERS},
    "generate": {
        "--elements": WHOLE,
        "--points": WHOLE,
        "--roll-off": SHARES,
        "--unit": st.sampled_from(["um", "m", "1", "kg", "", "1e-6 m", "µm"]),
        "--seed": WHOLE,
        "--rms": NUMBERS,
    },
    "estimate": {
        "--rms": NUMBERS,
        "--times": SERIES,
        "--viscosity": NUMBERS,
        "--medium": st.sampled_from(["medium.yaml", "none.yaml", "force.csv", "folder"]),
    },
}
# {command: options that it mostly has}
USUAL = {
    "contact": [["--force", SERIES]],
    "generate": [
        *(["--hurst", SHARES], ["--elements", st.sampled_from(["3", "9", "16"])]),
        *(["--rms", NUMBERS], ["--diameter", NUMBERS], ["--seed", st.sampled_from(["0", "7"])]),
    ],
    "estimate": [
        *(["--hurst", SHARES], ["--rms", st.sampled_from(["1", "2"])], ["--diameter", st.sampled_from(["5", "9"])]),
        *(["--force", st.sampled_from(["1", "2"])], ["--viscosity", NUMBERS], ["--times", SERIES]),
    ],
}
SURFACES = ["heights.npy", "heights.nc", *fuzz_surfaces.READ]
READ = {"indent": SURFACES, "contact": SURFACES, "kinetics": ["curve.nc"], "march": ["heights.npy", "heights.nc"]}
READ |= {"reduce": ["heights.npy", "heights.nc", "line.npy"], "plot": ["curve.nc", "heights.nc", "curve.csv"]}
ODD = ["--help", "--version", "--colour", "more.npy", "--", "-o", "\x00", "--tolerance=1e-2", "--force"]


@st.composite
def commands(draw):
    """Command lines: mostly complete, some with missing, repeated or unknown arguments."""
    command = draw(st.sampled_from(sorted(OPTIONS)))
    rarely = st.integers(0, 19).map(lambda n: n == 0)
    odd_files = ["none.npy", "folder", "older.nc", "pipe", ""]
    file = [draw(st.sampled_from(odd_files if draw(rarely) else READ[command]))] if command in READ else []
    given = [["-o", draw(st.sampled_from(FIGURES if command == "plot" else OUTPUTS))]]
    if command in ("indent", "contact", "march", "reduce"):
        usual = st.sampled_from(["1", "0.5"])
        given.append(["--spacing", draw(draw(st.sampled_from([usual, usual, NUMBERS, fuzz_surfaces.SPACINGS])))])
    if command == "march":
        method = draw(st.sampled_from(METHODS))
        given.append(["--method", method])
        in_medium = method == "second_order" or (method in ("events", "implicit") and draw(st.booleans()))
        given += [["--medium", "medium.yaml"]] if in_medium else []
        stepping = in_medium or method not in ("events", "")
        given += [["--times", draw(SERIES)]] if stepping and draw(st.integers(0, 4)) else []
    given += [[name, draw(values)] for name, values in USUAL.get(command, [])]
    if command == "kinetics":
        history = draw(st.integers(0, 2)) == 0
        given.append(["--force-history", "force.csv"] if history else ["--force", draw(NUMBERS)])
        given.append(["--medium", "medium.yaml"] if draw(st.booleans()) else ["--viscosity", draw(NUMBERS)])
        given += [["--times", draw(SERIES)]] if draw(st.integers(0, 3)) == 0 else []
    if command != "kinetics" or draw(rarely):
        for name in draw(st.lists(st.sampled_from(sorted(OPTIONS[command])), max_size=2)):
            given.append([name, draw(OPTIONS[command][name])])
    given += [["--flip"]] if command == "indent" and draw(rarely) else []
    given = [option for option in given if not draw(rarely)]
    arguments = [command, *file, *[text for option in given for text in option]]
    if draw(rarely):
        arguments.insert(draw(st.integers(0, len(arguments))), draw(st.sampled_from(ODD)))
    return arguments


FILES = {
    "heights.npy": npy_files(),
    "heights.nc": damaged(netcdf_heights()),
    "heights.txt": damaged(fuzz_surfaces.texts()),
    "heights.csv": damaged(fuzz_surfaces.texts()),
    "heights.asc": damaged(fuzz_surfaces.texts()),
    "heights.xyz": damaged(fuzz_surfaces.points()),
    "heights.tif": damaged(fuzz_surfaces.tiffs(arrays())),
    "curve.nc": damaged(curve_files()),
    "curve.csv": damaged(curve_tables()),
    "line.npy": npy_files(array_strategies.array_shapes(min_dims=1, max_dims=1, max_side=9)),
    "force.csv": HISTORIES,
    "medium.yaml": damaged(media()),
    "table.csv": TABLES,
    "force.npy": npy_files(array_strategies.array_shapes(min_dims=2, max_dims=2, min_side=2, max_side=2)),
}


@st.composite
def cases(draw):
    """A command line, and those files that it names, or that a medium may name."""
    arguments = draw(commands())
    named = {*arguments, *(["table.csv"] if "medium.yaml" in arguments else [])}
    return arguments, {name: draw(content) for name, content in FILES.items() if name in named}
