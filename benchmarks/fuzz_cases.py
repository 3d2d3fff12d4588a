"""Random command lines and the files that they name, most of them invalid; for fuzz.py.

What can be drawn is a text or bytes, a function of the random generator, or a list of such choices. Maps of heights are
those of file_campaign.py, with the faults of this module.
"""

import contextlib
import io
import re
import tempfile
from pathlib import Path

import numpy as np
import point_files
import text_files
import tifffile

import viscorough
from viscorough.cli import COMMANDS, subcommand

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
HUGE = b"{'descr': '<f8', 'fortran_order': False, 'shape': (10000000000, 10000000), }"
HUGE = b"\x93NUMPY\x01\x00" + len(HUGE).to_bytes(2, "little") + HUGE
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


def npy_file(shape):
    """Function that draws the bytes of an array of a shape, or of one that must not be loaded."""
    return [*[damaged(lambda random: npy_bytes(array(random, shape(random))))] * 6, [PICKLED, HUGE]]


# ---- files that the package or a library writes


def saved(result, suffix):
    """The bytes of a file of a result."""
    with tempfile.TemporaryDirectory() as folder:
        result.save(Path(folder) / f"saved{suffix}")
        return (Path(folder) / f"saved{suffix}").read_bytes()


def netcdf_file(random):
    return saved(viscorough.Indenter(random.random(random.integers(1, 7, 2)), 0.5, length_unit="um"), ".nc")


def tiff_file(random):
    """A map, or pages or colours; of ImageJ with a unit, or of any program."""
    file, kind = io.BytesIO(), one_of(random, ["f4", "u2", "u1"])
    options = one_of(random, [{}, {}, {"imagej": True, "resolution": (2, 4), "metadata": {"unit": "um"}}])
    values = (99 * random.random(random.integers(1, 7, one_of(random, [2, 2, 2, 3])))).astype(kind)
    tifffile.imwrite(file, values, photometric="minisblack", **options)
    return file.getvalue()


def curve_file(suffix):
    """Function that draws a loading curve, as the package writes it."""

    def draw(random):
        heights = one_of(random, [1.0, 1e-6, 1e100]) * random.random(random.integers(2, 7))
        unit = one_of(random, ["1", "m", "um"])
        return saved(viscorough.reduce(viscorough.Indenter(heights, 1.0, length_unit=unit)), suffix)

    return draw


def columns(random):
    """Times and forces, or compliances, that never decrease, below a heading with units or none."""
    rows = np.cumsum(random.random((random.integers(1, 7), 2)), axis=0).tolist()
    heading = one_of(random, ["0,0\n", "t,F\n", "t [ms],F [mN]\n", "t [s],J [1/MPa]\n", "t [kg],F\n"])
    return "".join([heading, *(f"{first!r},{second!r}\n" for first, second in rows)]).encode()


def record(random):
    """Times, and depths that grow, up to some of those of the curves."""
    rows = np.cumsum(random.random((random.integers(2, 7), 2)), axis=0) * [1.0, one_of(random, [0.02, 0.2, 2.0, 1e-7])]
    heading = one_of(random, ["", "t,u\n", "t [ms],u [um]\n", "t [s],u [N]\n"])
    return "".join([heading, *(f"{first!r},{second!r}\n" for first, second in rows.tolist())]).encode()


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


def campaign_file(*makers):
    """Function that draws a file of file_campaign.py."""
    return lambda random: one_of(random, makers)(random).content


def sides(least, most, dimensions):
    """Function that draws a shape."""
    return lambda random: tuple(random.integers(least, most + 1, dimensions))


MATRICES = damaged(campaign_file(text_files.matrix))
FILES = {
    "heights.npy": npy_file(sides(1, 7, 2)),
    "heights.nc": damaged(netcdf_file),
    "heights.txt": MATRICES,
    "heights.csv": MATRICES,
    "heights.asc": damaged(campaign_file(point_files.esri)),
    "heights.xyz": damaged(campaign_file(point_files.points, point_files.zygo)),
    "heights.tif": damaged(tiff_file),
    "curve.nc": damaged(curve_file(".nc")),
    "curve.csv": damaged(curve_file(".csv")),
    "line.npy": npy_file(sides(1, 9, 1)),
    "force.csv": damaged(columns),
    "force.npy": npy_file(lambda _: (2, 2)),
    "medium.yaml": damaged(MEDIA),
    "table.csv": damaged(columns),
    "record.csv": damaged(record),
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
MADE_MEDIA = [*["out.yaml"] * 40, "out.yml", "out.nc", "out", "none/out.yaml", "folder", "curve.yaml", "é.yaml"]
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
    name: [option for option in subcommand(name).params if option.opts[0][0] == "-" and option.opts[0] not in LEFT_OUT]
    for name in COMMANDS
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
READ |= {"plot": ["curve.nc", "heights.nc", "curve.csv"], "creep": ["curve.nc", "curve.csv"]}
WRITTEN = {"plot": FIGURES, "creep": MADE_MEDIA}  # by the others: OUTPUTS
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
    given = [["-o", one_of(random, WRITTEN.get(command, OUTPUTS))]]
    if command in ("indent", "contact", "march", "reduce") and (file[0].endswith(".npy") or random.random() < 0.3):
        given.append(["--spacing", drawn(random, [*[VALUES_OF["--spacing"]] * 9, NUMBERS])])
    if command == "march":
        given += method_of_march(random)
    given += [[name, drawn(random, values)] for name, values in USUAL.get(command, {}).items()]
    if command == "creep":
        file.append("record.csv")
    if command in ("kinetics", "creep"):
        given.append(one_of(random, [["--force-history", "force.csv"], *[["--force", drawn(random, NUMBERS)]] * 2]))
    if command == "kinetics":
        given.append(one_of(random, [["--medium", "medium.yaml"], ["--viscosity", drawn(random, NUMBERS)]]))
        given += [["--times", drawn(random, SERIES)]] if random.random() < 0.25 else []
    exclusive = command in ("kinetics", "creep")  # options that exclude each other
    if OPTIONS[command] and (not exclusive or random.random() < 0.05):
        given += [option(random, one_of(random, OPTIONS[command])) for _ in range(one_of(random, [0, 0, 1, 2]))]
    given = [words for words in given if random.random() > 0.02]
    arguments = [command, *file, *[text for words in given for text in words]]
    if random.random() < 0.05:
        arguments.insert(random.integers(len(arguments) + 1), one_of(random, ODD))
    return arguments


def method_of_march(random):
    """The method of a direct integration, mostly with the options that it needs."""
    method = one_of(random, METHODS)
    in_medium = method == "second_order" or (method == "events" and random.random() < 0.5)
    stepping = in_medium or method not in ("events", "")
    given = [["--method", method]] + [["--medium", "medium.yaml"]] * in_medium
    return given + ([["--times", drawn(random, SERIES)]] if stepping and random.random() < 0.8 else [])


def case(random):
    """A command line, and those files that it names, or that a medium may name."""
    arguments = arguments_of(random)
    named = {*arguments, *(["table.csv"] if "medium.yaml" in arguments else [])}
    return arguments, {name: drawn(random, content) for name, content in FILES.items() if name in named}
