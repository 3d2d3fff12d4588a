"""Random command lines and their files, many of them invalid; for fuzz.py.

A command line is one of a list of valid lines with random numbers; words of it are replaced, inserted or left out. Its
files are valid, and some of them are then damaged.
"""

import io
import re
import tempfile
from pathlib import Path

import numpy as np

import viscorough
from viscorough.cli import cli

STARTED = "code-was-run"  # name of the file that code in a file would make


def one_of(random, choices):
    return choices[random.integers(len(choices))]


# ---- faults of files

ODD_FIELDS = [b"nan", b"inf", b"-1", b"0", b"1e400", b"", b"time", b"1N", b"0x1", b"1_0", "٣".encode(), b"#", b'"1"']
ODD_FIELDS += [b"\xef\xbb\xbf", b"\x00", b"***", b"-9999", b"1,5", b"1d3", b"--", b"-5e300", b"9**9**9"]
ODD_FIELDS += [b".nan", b"[1, 2]", b"{a: 1}", b"true", b"null", b"'1 Pa'", b"2 MPa", b"''", b"*a", b"folder"]
ODD_FIELDS += [f"!!python/object/apply:open ['{STARTED}', w]".encode(), b"\nx: 1\n", b"1\n"]


def damaged(random, whole):
    """Return bytes with a field replaced, bytes changed, a part or a line missing or repeated, or unrelated bytes."""
    fields = [field.span() for field in re.finditer(rb"[^\s,;:]+", whole)] or [(0, 0)]
    lines = whole.splitlines(keepends=True)
    line, (begin, end) = int(random.integers(len(lines) + 1)), one_of(random, fields)
    i, j = sorted(int(place) for place in random.integers(len(whole) + 1, size=2))
    changes = [
        *[whole[:begin] + one_of(random, ODD_FIELDS) + whole[end:]] * 3,
        *[b"".join(lines[:line] + lines[line + 1 :]), b"".join(lines[: line + 1] + lines[line:])],
        *[whole[:i] + random.bytes(2) + whole[i + 2 :], whole[:i] + bytes(len(whole[i:j])) + whole[j:]],
        *[whole[:i], whole[:i] + whole[j:], whole[:j] + whole[i:], whole + b"x", random.bytes(200), b""],
    ]
    return one_of(random, changes)


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
TYPES = [*["f8"] * 20, "f4", "f2", ">f8", ">f4", "g", "i1", "u1", "i2", ">i4", "i8", "u8", "?", "c16", "U3", "M8[s]"]


def npy(shape):
    """Draw a .npy file of heights: rough, terraced, with extreme entries, of any type, or not loadable."""

    def draw(random):
        values = one_of(random, [random.standard_normal(shape), random.integers(0, 4, shape) + 0.0])
        values *= one_of(random, [1.0, 1.0, 1.0, 1e-9, 1e100, 1e300, 1e-300])
        if random.random() < 0.2:
            values.flat[random.integers(values.size, size=2)] = one_of(random, EXTREME)
        with np.errstate(all="ignore"):
            typed = npy_bytes(values.astype(one_of(random, TYPES)))
        return one_of(random, [typed] * 20 + [PICKLED, HUGE])

    return draw


# ---- files that the package or a library writes


def saved(result):
    """Return the bytes of a file of a result."""
    with tempfile.TemporaryDirectory() as folder:
        viscorough.save(result, path := Path(folder) / "saved.nc")
        return path.read_bytes()


def netcdf_file(random):
    return saved(viscorough.Indenter(random.random(random.integers(1, 7, 2)), 0.5, length_unit="um"))


def matrix(random):
    """Return a text with a matrix of heights, in columns that a random delimiter separates."""
    file, delimiter = io.StringIO(), one_of(random, [" ", ",", ";", "\t"])
    np.savetxt(file, random.standard_normal(random.integers(4, 9, 2)), delimiter=delimiter, header="a map")
    return file.getvalue().encode()


def curve_file(random):
    heights = one_of(random, [1.0, 1e-6, 1e100]) * random.random(random.integers(2, 7))
    return saved(viscorough.reduce(viscorough.Indenter(heights, 1.0, length_unit=one_of(random, ["1", "m", "um"]))))


def columns(*headings):
    """Return a function that draws two columns that never decrease, below a heading with or without units."""

    def draw(random):
        rows = np.cumsum(random.random((random.integers(2, 7), 2)), axis=0) * [1.0, one_of(random, [0.02, 1.0, 1e-7])]
        return "".join([one_of(random, headings), *(f"{a!r},{b!r}\n" for a, b in rows.tolist())]).encode()

    return draw


MEDIA = [
    b"kind: newtonian\nviscosity: 2.5\n",
    b"kind: maxwell\nshear_modulus: 3e-4\nviscosity: 7\n",
    b"kind: kelvin_voigt\nshear_modulus: 1e6\nviscosity: 1\n",
    b"kind: standard_linear_solid\ninstantaneous_modulus: 8\nrelaxed_modulus: 1\nrelaxation_time: 0.5\n",
    b"kind: prony\nrelaxed_modulus: 1\nmoduli: [1, 2.5]\nrelaxation_times: [0.5, 1e6]\n",
    b"kind: springpot\nmodulus: 7\nexponent: 0.5\n",
]
FILES = {
    "heights.npy": npy((5, 6)),
    "heights.nc": netcdf_file,
    "heights.txt": matrix,
    "curve.nc": curve_file,
    "line.npy": npy(9),
    "force.csv": columns("0,0\n", "t,F\n", "t [ms],F [mN]\n", "t [kg],F\n"),
    "force.npy": npy((2, 2)),
    "medium.yaml": lambda random: one_of(random, MEDIA),
}

# ---- command lines

# Valid command lines: N stands for a number, S for an increasing series, F for a fraction.
COMMAND_LINES = (
    *("indent heights.npy --spacing 1 -o out.nc", "indent heights.npy --spacing 1,2 --unit um --depths S -o out.csv"),
    *("indent heights.npy --spacing 1 --until-fraction F -o out.nc", "indent heights.nc --forces S -o out.nc"),
    "indent heights.npy --spacing 1 --audit -o out.nc",
    "indent heights.npy --spacing 1 --unit inch --crop 0:5,0:4 --detrend plane --fill harmonic -o out.nc",
    *("indent heights.txt --spacing 1 -o out.nc", "contact heights.npy --spacing 1 --force S -o out.nc"),
    "contact heights.npy --spacing 1 --force N --young 3 --poisson 0.3 -o out.nc",
    *("contact heights.nc --depth S -o out.nc", "march heights.npy --spacing 1 --method events --times S -o out.nc"),
    *(f"march heights.nc --method {method} --times S -o out.nc" for method in ("events", "implicit")),
    "march heights.npy --spacing 1 --method events --force-history force.csv -o out.nc",
    "march heights.npy --spacing 1 --method implicit --medium medium.yaml --times S -o out.nc",
    *("reduce line.npy --spacing 1 -o out.nc", "reduce heights.npy --spacing 1 --realizations 3 -o out.nc"),
    *("kinetics curve.nc --force N --viscosity N -o out.nc", "kinetics curve.nc --force N --viscosity N -o out.csv"),
    "kinetics curve.nc --force-history force.csv --medium medium.yaml -o out.nc",
    "kinetics curve.nc --force-history force.npy --viscosity N -o out.nc",
    "kinetics curve.nc --force N --medium medium.yaml --times S -o out.nc",
    *("plot curve.nc -o out.png", "plot curve.nc -o out.svg", "plot heights.nc -o out.png"),
    "generate --hurst F --elements 9 --rms N --diameter N --seed 7 -o out.nc",
    "estimate --hurst 0.7 --rms 1 --diameter 9 --force 1 --viscosity N --times S -o out.nc",
)
NUMBERS = [*map(repr, EXTREME), "", "a", "1e400", "1e-400", "1_0", "0x1", "１", " 1 ", "1,5", "--help", "-", "3", "64"]
QUANTITIES = ["1 N", "5 mN", "2 MPa", "3 um", "1e-3 m", "1 kg", "2 ", "1 N,2", "1 mN,2 mN", "500 nm,0.5 um", "1,2,3"]
UNITS = ["um", "nm", "m", "1", "kg", "1e-6 m", "µm", "9**9**9", "\x00"]
CHOICES = ["0:2,0:2", "2:1,0:1", "0:99,0:99", "0,1,2", "plane", "sphere", "none", "springpot", "magic", "heights", "λ"]
OUTPUTS = [".", "/", "none/out.nc", "folder", "folder/out.nc", "out", "a\nb.nc", "é.nc", "x" * 300, "pipe", "out.yml"]
OUTPUTS += ["link.nc", "dangling.nc", "older.nc", "\udcff.nc", "none.npy", "none.csv", "out.png", "none/out.png"]
ODD = ["--help", "--version", "--colour", "more.npy", "--", "-o", "--tolerance=1e-2", "--force", *FILES]
WORDS = (NUMBERS, QUANTITIES, UNITS, CHOICES, OUTPUTS, ODD)


def number(random):
    return repr(random.uniform(1e-3, 10))


def series(random):
    return ",".join(map(repr, np.sort(random.uniform(1e-3, 5, random.integers(1, 5))).tolist()))


DRAWN = {"N": number, "S": series, "F": lambda random: repr(random.random())}


def valid_arguments(random, line):
    """Draw the words of a command line, with its random numbers."""
    return [DRAWN[word](random) if word in DRAWN else word for word in line.split()]


def changed(random, arguments):
    """Return a command line with a word replaced, inserted or left out, or with a further option."""
    place, word = int(random.integers(1, len(arguments))), one_of(random, one_of(random, WORDS))
    before, after = arguments[:place], arguments[place:]
    # The second of these options may print.
    options = [parameter.opts[0] for parameter in cli.commands[arguments[0]].params if parameter.opts[0][0] == "-"]
    option = one_of(random, [name for name in options if name != "--progress"])
    value = one_of(random, [word, number(random), series(random)])
    changes = [[*before, word, *after[1:]], [*before, word, *after], before + after[1:]]
    return one_of(random, [*changes, *[[*arguments, option, value]] * 3, [*arguments, option]])


def case(random):
    """Draw a command line, and the files that it names."""
    arguments = valid_arguments(random, one_of(random, COMMAND_LINES))
    while random.random() < 0.4:
        arguments = changed(random, arguments)
    return arguments, files_of(random, arguments, faults=0.2)


def files_of(random, arguments, faults):
    """Return {name: bytes} of the files that a command line names; faults : share of damaged files"""
    named = set(arguments)
    whole = {name: draw(random) for name, draw in FILES.items() if name in named}
    return {name: damaged(random, b) if random.random() < faults else b for name, b in whole.items()}
