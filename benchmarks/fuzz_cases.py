"""Random command lines and the files that they name, most of them invalid; for fuzz.py.

What can be drawn is a text or bytes, a function of the random generator, or a list of such choices. Maps of heights,
histories, creep tables and curves in text are those of file_campaign.py, with the faults of this module.
"""

import contextlib
import io
import re
import tempfile
from pathlib import Path

import binary_files
import column_files
import netCDF4
import numpy as np
import point_files
import text_files

from viscorough.cli import cli
from viscorough.io import netcdf
from viscorough.io.curves import curve_to_content
from viscorough.io.motion import with_motion
from viscorough.io.unpacking import STORAGE
from viscorough.loading_curve import LoadingCurve

STARTED = "code-was-run"  # the file that code in a file would make


def drawn(random, choice):
    """A random choice, nested until it is text or bytes."""
    while not isinstance(choice, (str, bytes)):
        choice = choice(random) if callable(choice) else one_of(random, choice)
    return choice


def one_of(random, choices):
    return choices[random.integers(len(choices))]


# ---- faults of files

ODD_FIELDS = [b"nan", b"inf", b"-1", b"0", b"1e400", b"", b"time", b"1N", b"0x1", b"1_0", "٣".encode(), b"#", b'"1"']
ODD_FIELDS += [b"\xef\xbb\xbf", b"\x00", b"***", b"-9999", b"1,5", b"1d3", b"--", b"-5e300", b"9**9**9"]
ODD_FIELDS += [b".nan", b"[1, 2]", b"{a: 1}", b"true", b"null", b"'1 Pa'", b"2 MPa", b"''", b"*a", b"folder"]
ODD_FIELDS += [f"!!python/object/apply:open ['{STARTED}', w]".encode()]


def place(random, whole):
    return int(random.integers(len(whole) + 1))


def flipped(random, whole):
    changed = bytearray(whole)
    for _ in range(random.integers(1, 5) if whole else 0):
        changed[random.integers(len(whole))] ^= 1 << random.integers(8)
    return bytes(changed)


def zeroed(random, whole):
    at = place(random, whole)
    return whole[:at] + bytes(len(whole[at : at + 64])) + whole[at + 64 :]


def odd_field(random, whole):
    fields = [field.span() for field in re.finditer(rb"[^\s,;:]+", whole)] or [(0, 0)]
    begin, end = one_of(random, fields)
    return whole[:begin] + one_of(random, ODD_FIELDS) + whole[end:]


def odd_line(random, whole):
    """Text with a line removed, repeated or replaced."""
    lines = whole.splitlines(keepends=True) or [b""]
    at = random.integers(len(lines))
    return b"".join([*lines[:at], *one_of(random, [[], 2 * [lines[at]], [b"1\n"], [b"x: 1\n"]]), *lines[at + 1 :]])


FAULTS = (
    *(flipped, zeroed, *[odd_field] * 3, *[odd_line] * 2),
    lambda random, whole: whole[: place(random, whole)],
    lambda random, _: random.bytes(random.integers(200)),
    lambda _, whole: 2 * whole,
    lambda _, whole: whole + b"x",
    lambda *_: b"",
)


def damaged(content):
    """Function that draws content, with a fault three times in ten."""

    def draw(random):
        whole = drawn(random, content)
        return one_of(random, FAULTS)(random, whole) if random.random() < 0.3 else whole

    return draw


# ---- arrays


class Payload:
    """Object that makes a file when it is unpickled."""

    def __reduce__(self):
        return open, (STARTED, "w")


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
EXTREME = [0.0, -0.0, -1.0, np.nan, np.inf, -np.inf, 5e-324, 1e-300, 1e300, 1.7e308, -1.7e308, 2.0**53 + 2]
TYPES = [*["f8"] * 20, "f8", "f4", "f2", ">f8", ">f4", "g", "i1", "u1", "i2", ">i4", "i8", "u8"]
TYPES += ["?", "c16", "U3", "S2", "M8[s]", "m8[s]", "V4", "f8,i4"]


def array(random, shape):
    """Heights: rough, terraced, constant; with extreme entries; of any type."""
    values = one_of(random, [random.standard_normal(shape), random.integers(0, 4, shape), np.zeros(shape)])
    values = np.array(values * one_of(random, [1.0, 1.0, 1.0, 1e-2, 1e-9, 1e100, 1e307, 1e-300]))
    for _ in range(one_of(random, [0, 0, 0, 1, 2]) if values.size else 0):
        values.flat[random.integers(values.size)] = one_of(random, EXTREME)
    if random.random() < 0.25:
        values[random.random(shape) < 0.3] = np.nan
    kind = np.dtype(one_of(random, TYPES))
    with np.errstate(all="ignore"), contextlib.suppress(TypeError, ValueError):
        return values.astype(kind)
    return np.zeros(shape, kind)


def any_shape(random):
    return tuple(random.integers(0, 5, random.integers(4)))


def npy_file(shape):
    """Function that draws the bytes of an array of a shape, or of code."""
    return [*[damaged(lambda random: npy_bytes(array(random, shape(random))))] * 6, [PICKLED, *CODE]]


# ---- NetCDF

VALUES = ["", "m", "um", "1", "1e-6 m", "true", "9", "nan", "é", b"\xff", ["a", "b"], 3, np.int8(-1), np.float32(1e20)]
VALUES += [*EXTREME, np.uint64(2**63), np.array([1.0, 2.0])]
NAMES = [*STORAGE, "units", "units", "long_name", "Conventions", "elements", "method", "title", "é"]


def attributes(random):
    return {one_of(random, NAMES): one_of(random, VALUES) for _ in range(random.integers(4))}


def changed_netcdf(content):
    """Function that draws a NetCDF file with variables and attributes changed, added or removed."""

    def draw(random):
        with netCDF4.Dataset("old.nc", memory=drawn(random, content)) as old:
            old.set_auto_maskandscale(False)
            variables = {name: [v.dimensions, np.array(v[...]), dict(v.__dict__)] for name, v in old.variables.items()}
            global_attributes = dict(old.__dict__) | (attributes(random) if random.random() < 0.3 else {})
        for _ in range(one_of(random, [0, 0, 1, 1, 2])):
            change(random, variables)
        return netcdf_bytes(variables, global_attributes)

    return draw


def change(random, variables):
    """Change one variable, {name: [dimensions, values, attributes]}, remove it or add another."""
    name = one_of(random, list(variables))
    values = variables[name][1]
    edit = one_of(random, ["entry", "type", "attributes", "units", "missing", "added"])
    with contextlib.suppress(IndexError, OverflowError, ValueError), np.errstate(all="ignore"):
        if edit == "entry" and values.size:
            values.flat[random.integers(values.size)] = one_of(random, EXTREME)
        elif edit == "type":
            variables[name][1] = np.nan_to_num(values).astype(one_of(random, ["S3", "i4", "f4", "u1"]))
        elif edit == "attributes":
            variables[name][2].update(attributes(random))
        elif edit == "units":
            variables[name][2].pop("units", None)
        elif edit == "missing" and len(variables) > 1:
            del variables[name]
        elif edit == "added":
            added = array(random, any_shape(random))
            variables["added"] = [tuple(f"d{axis}" for axis in range(added.ndim)), added, attributes(random)]


def netcdf_bytes(variables, global_attributes):
    """A NetCDF file of those variables and attributes that the library accepts."""
    file = netCDF4.Dataset("new.nc", "w", memory=4096)
    for name, (dimensions, values, own) in variables.items():
        with contextlib.suppress(Exception), np.errstate(all="ignore"):
            for dimension, size in zip(dimensions, values.shape, strict=True):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, size)
            values = values.astype(values.dtype.newbyteorder("="))
            variable = file.createVariable(name, values.dtype, dimensions, fill_value=own.pop("_FillValue", None))
            variable.set_auto_maskandscale(False)
            set_attributes(variable, own)
            variable[...] = values
    set_attributes(file, global_attributes)
    return bytes(file.close())


def set_attributes(owner, values):
    for name, value in values.items():
        with contextlib.suppress(Exception):
            owner.setncattr(name, value)


def curve_file(random):
    """A loading curve in NetCDF, with motion or without."""
    levels = int(random.integers(1, 7))
    scale = one_of(random, [1.0, 1.0, 1e-6, 1e150, 1e-160])
    depth, stiffness = scale * np.cumsum(random.random((2, levels)) + 0.1, axis=1)
    force = np.cumsum((np.append(0, stiffness[:-1]) + stiffness) / 2 * np.diff(depth, prepend=0))
    fields = levels + 9, "boundary elements", 1e-3, 5, 1e-3 * random.random(levels), one_of(random, ["1", "m", "um"])
    content = curve_to_content(LoadingCurve(depth, force, stiffness, np.arange(1, levels + 1), *fields))
    content = with_motion(content, depth, force) if random.random() < 0.5 else content
    with tempfile.TemporaryDirectory() as folder:
        netcdf.write(content, Path(folder) / "curve.nc")
        return (Path(folder) / "curve.nc").read_bytes()


# ---- files

MEDIA = [
    b"kind: newtonian\nviscosity: 2.5\n",
    b"kind: maxwell\nshear_modulus: 3e-4\nviscosity: 7\n",
    b"kind: kelvin_voigt\nshear_modulus: 1e6\nviscosity: 1\n",
    b"kind: standard_linear_solid\ninstantaneous_modulus: 8\nrelaxed_modulus: 1\nrelaxation_time: 0.5\n",
    b"kind: prony\nrelaxed_modulus: 1\nmoduli: [1, 2.5]\nrelaxation_times: [0.5, 1e6]\n",
    b"kind: springpot\nmodulus: 7\nexponent: 0.5\n",
    *[b"kind: creep_table\nfile: table.csv\n"] * 2,
    b"kind: creep_table\nfile: ../table.csv\n",
]


def campaign_file(*makers, kind=None):
    """Function that draws a file of file_campaign.py, of a kind if its maker has several."""

    def draw(random):
        while True:
            case = one_of(random, makers)(random)
            if kind in (None, case.kind):
                return case.content

    return draw


def sides(least, most, dimensions):
    """Function that draws a shape."""
    return lambda random: tuple(random.integers(least, most + 1, dimensions))


MATRICES = damaged(campaign_file(text_files.matrix))
FILES = {
    "heights.npy": npy_file(sides(1, 7, 2)),
    "heights.nc": damaged(changed_netcdf(campaign_file(binary_files.netcdf))),
    "heights.txt": MATRICES,
    "heights.csv": MATRICES,
    "heights.asc": damaged(campaign_file(point_files.esri)),
    "heights.xyz": damaged(campaign_file(point_files.points, point_files.zygo)),
    "heights.tif": damaged(campaign_file(binary_files.tiff, binary_files.geotiff, binary_files.imagej)),
    "curve.nc": damaged(changed_netcdf(curve_file)),
    "curve.csv": damaged(campaign_file(column_files.curve)),
    "line.npy": npy_file(sides(1, 9, 1)),
    "force.csv": damaged(campaign_file(column_files.two_columns, kind="force history")),
    "force.npy": npy_file(lambda _: (2, 2)),
    "medium.yaml": damaged(MEDIA),
    "table.csv": damaged(campaign_file(column_files.two_columns, kind="creep table")),
}

# ---- options

ODD_NUMBERS = [*map(repr, EXTREME), "", "a", "1e400", "1e-400", "1_0", "0x1", "１", " 1 ", "1,5", "--help", "-"]
NUMBERS = [
    *[lambda random: repr(random.uniform(1e-3, 10))] * 20,
    lambda random: repr(np.frombuffer(random.bytes(8))[0].item()),
    ODD_NUMBERS,
]
SERIES = [
    *[lambda random: ",".join(map(repr, np.sort(random.uniform(1e-3, 5, random.integers(1, 5))).tolist()))] * 9,
    lambda random: ",".join(drawn(random, NUMBERS) for _ in range(random.integers(4))),
]
SHARES = [*[["0.5", "0.9", "1", "0.1"]] * 9, NUMBERS]
OUTPUTS = (
    *(*["out.nc"] * 120, *["out.csv"] * 20),
    *("", ".", "/", "none/out.nc", "folder", "folder/out.nc", "out", "-", "a\nb.nc", "é.nc", "x" * 300, "pipe"),
    *("heights.npy", "heights.nc", "force.csv", "curve.nc", "link.nc", "dangling.nc", "older.nc", "\udcff.nc"),
)
FIGURES = [*["out.png"] * 40, "out.svg", "out.nc", "out", "none/out.png", "folder", "pipe", "curve.nc", "é.png"]
METHODS = [*["events", "explicit", "heun", "implicit", "second_order"] * 4, "magic", ""]
QUANTITIES = [NUMBERS, ["1 N", "5 mN", "2 MPa", "3 um", "1e-3 m", "1 kg", "2 ", "1 N,2", "1 mN,2 mN"]]
# Values of options, by the name of the option or else of its type in the command line
VALUES_OF = {
    "--force-history": ["force.csv", "force.npy", "older.nc", "none.csv", "folder", "pipe"],
    "--medium": ["medium.yaml", "medium.yaml", "older.nc", "none.yaml", "force.csv", "folder", "pipe"],
    "--spacing": [*["1", "0.5"] * 6, "1,2", "2,0.5", "1,9", "1 um", "500 nm,0.5 um", "1 V", ",", "1,2,3"],
    "--unit": ["um", "nm", "m", "1", "kg", "", "1e-6 m", "µm", "9**9**9", "\x00"],
    "--channel": ["0", "1", "z", "heights", "", "λ"],
    "--nodata": ["0", "-9999", "1e38", "nan", "", "0,1,2", "a"],
    "--crop": ["0:2,0:2", "0:1,0:1", "1:3,0:2", "2:1,0:1", "0:99,0:99", "", "a"],
    "PositiveNumber": SHARES,
    "Quantity": QUANTITIES,
    "Increasing": SERIES,
    "IntRange": ["3", "9", "64", "0", "-1", "1.5", "99999999", "", "nan"],
}
LEFT_OUT = {"-o", "--progress"}  # every command has the first, and the second may print
OPTIONS = {
    name: [option for option in command.params if option.opts[0][0] == "-" and option.opts[0] not in LEFT_OUT]
    for name, command in cli.commands.items()
}
# {command: options that it mostly has}
USUAL = {
    "contact": {"--force": SERIES},
    "generate": {
        **{"--hurst": SHARES, "--elements": ["3", "9", "16"], "--rms": NUMBERS, "--diameter": NUMBERS},
        "--seed": ["0", "7"],
    },
    "estimate": {
        **{"--hurst": SHARES, "--rms": ["1", "2"], "--diameter": ["5", "9"], "--force": ["1", "2"]},
        **{"--viscosity": NUMBERS, "--times": SERIES},
    },
}
SURFACES = [name for name in FILES if name.startswith("heights")]
READ = {"indent": SURFACES, "contact": SURFACES, "kinetics": ["curve.nc", "curve.csv"]}
READ |= {"march": ["heights.npy", "heights.nc"], "reduce": ["heights.npy", "heights.nc", "line.npy"]}
READ |= {"plot": ["curve.nc", "heights.nc", "curve.csv"]}
ODD = ["--help", "--version", "--colour", "more.npy", "--", "-o", "\x00", "--tolerance=1e-2", "--force"]


def option(random, parameter):
    """An option of the command line with a value."""
    name, kind = parameter.opts[0], parameter.type
    if parameter.is_flag:
        return [name]
    choices = [*getattr(kind, "choices", ()), ""] * 2
    return [name, drawn(random, VALUES_OF.get(name, VALUES_OF.get(type(kind).__name__, [*choices, NUMBERS])))]


def arguments_of(random):
    """A command line: mostly complete, some with missing, repeated or unknown arguments."""
    command = one_of(random, sorted(OPTIONS))
    odd_files = ["none.npy", "folder", "older.nc", "pipe", ""]
    file = [one_of(random, odd_files if random.random() < 0.05 else READ[command])] if command in READ else []
    given = [["-o", one_of(random, FIGURES if command == "plot" else OUTPUTS)]]
    if command in ("indent", "contact", "march", "reduce") and (file[0].endswith(".npy") or random.random() < 0.3):
        given.append(["--spacing", drawn(random, [*[VALUES_OF["--spacing"]] * 9, NUMBERS])])
    if command == "march":
        given += method_of_march(random)
    given += [[name, drawn(random, values)] for name, values in USUAL.get(command, {}).items()]
    if command == "kinetics":
        given.append(one_of(random, [["--force-history", "force.csv"], *[["--force", drawn(random, NUMBERS)]] * 2]))
        given.append(one_of(random, [["--medium", "medium.yaml"], ["--viscosity", drawn(random, NUMBERS)]]))
        given += [["--times", drawn(random, SERIES)]] if random.random() < 0.25 else []
    if OPTIONS[command] and (command != "kinetics" or random.random() < 0.05):  # whose options exclude each other
        given += [option(random, one_of(random, OPTIONS[command])) for _ in range(one_of(random, [0, 0, 1, 2]))]
    given = [words for words in given if random.random() > 0.02]
    arguments = [command, *file, *[text for words in given for text in words]]
    if random.random() < 0.05:
        arguments.insert(random.integers(len(arguments) + 1), one_of(random, ODD))
    return arguments


def method_of_march(random):
    """The method of a direct integration, mostly with the options that it needs."""
    method = one_of(random, METHODS)
    in_medium = method == "second_order" or (method in ("events", "implicit") and random.random() < 0.5)
    stepping = in_medium or method not in ("events", "")
    given = [["--method", method]] + [["--medium", "medium.yaml"]] * in_medium
    return given + ([["--times", drawn(random, SERIES)]] if stepping and random.random() < 0.8 else [])


def case(random):
    """A command line, and those files that it names, or that a medium may name."""
    arguments = arguments_of(random)
    named = {*arguments, *(["table.csv"] if "medium.yaml" in arguments else [])}
    return arguments, {name: drawn(random, content) for name, content in FILES.items() if name in named}
