"""Errors in the options of each command: one line names the option, the error and the allowed values.

Refusals of readers and solvers are tested together with them. These tests cover the checks of the command line.
"""

import os

import numpy as np
import pytest

import viscorough
from support.command_line import save_in, sphere_heights
from support.curves import random_curve
from viscorough import Indenter
from viscorough.io.netcdf import write

INDENT, CONTACT = (f"{command} heights.npy --spacing 1 --unit 1 -o out.nc" for command in ("indent", "contact"))
CONTACT_UM, MARCH = "contact um.nc -o out.nc", f"{INDENT.replace('indent', 'march')} --method"
KINETICS = "kinetics curve.nc -o out.nc"
ESTIMATE = "estimate --hurst 0.8 --diameter 0.01 --times 1"
GENERATE = "generate --hurst 0.7 --rms 1 --diameter 34 --seed 5 -o made.nc"
EXCLUDE = "exclude each other; one of them is allowed"
QUANTITY = "is not a number above 0 and finite, plain or with a unit"
INCREASING, NO_UNIT = "each larger than the one before", "needs a plain number, since the unit of length is not known"
# Opening a pipe would wait until another process writes into it.
OF_PIPES = ["kinetics pipe.nc --force 1 --viscosity 1 -o out.nc", "indent pipe.npy -o out.nc"]
OF_PIPES += [f"{KINETICS} --viscosity 1 --force-history pipe.csv", f"{KINETICS} --force 1 --medium pipe.yaml"]
KIND = "unknown kind of file; allowed:"
RESULTS = ".nc (NetCDF), .csv (table)"
WRITERS = [
    "indent heights.npy --spacing 1 --unit 1",
    "contact heights.npy --spacing 1 --unit 1 --depth 1",
    "reduce line.npy --spacing 1 --unit 1",
]
WRITERS += ["kinetics curve.nc --force 1 --viscosity 1", f"{ESTIMATE} --rms 1 --force 1 --viscosity 1"]
WRITERS += ["march heights.npy --spacing 1 --unit 1 --method events --times 1"]
MAP = GENERATE.removesuffix(" -o made.nc") + " --elements 5"
MISTAKES = [
    ("indent heights.npy --spacing 1 --unit 1", "--output"),
    (f"{INDENT} --tolerance 0", "'--tolerance': 0.0 is not in the range 0<x<=0.1"),
    (f"{INDENT} --until-fraction nan", "'--until-fraction': 'nan' is not a finite number"),
    *[(f"{INDENT} --depths {depths}", text) for depths, text in (("1,,2", QUANTITY), ("2,1", INCREASING))],
    (f"{INDENT} --crop 0:5,0:10", "--crop to rows 0:10; within 0:9 is allowed"),
    ("indent um.nc -o um.nc", "replace the heights"),
    ("indent heights.npy --spacing 1 --unit 1 -o curve.nc/out.nc", "curve.nc/out.nc: there is no folder curve.nc"),
    (f"{INDENT} --forces 1 --depths 1", EXCLUDE),
    (f"{INDENT} --crop 0:2,0:9 --grid-error", "every n-th point, n = 2, of a map of 9 x 2 points"),
    (CONTACT, "one of --force and --depth is needed"),
    *[(f"{CONTACT} --force {force}", QUANTITY) for force in ("0", "much")],
    (f"{CONTACT_UM} --force '2 mN,1 uN' --young 1", INCREASING),
    (f"{CONTACT_UM} --force '1 mN,2' --young 1", "some numbers have a unit; write '1 mN,2 mN'"),
    (f"{CONTACT_UM} --force '1,5 mN' --young 1", "write '1 mN,5 mN', or '1.5 mN' for one number"),
    (f"{CONTACT_UM} --force 1 --young '1,5 MPa'", "'1,5 MPa' has a comma in its number; write '1.5 MPa'"),
    (f"{CONTACT_UM} --force 1 mN --young 2 MPa", '--force 1 mN: the shell splits this value; write --force "1 mN"'),
    (
        f"{KINETICS} --force 1 --viscosity 1e6 Pa·s",
        "--viscosity 1e6 Pa·s: the shell splits this value; write --viscosity",
    ),
    *[
        (
            f"plot heights.npy -o out.png --unit um --spacing '{text}'",
            f"write '{one}' for one distance, or '{two}' for two",
        )
        for text, one, two in (
            ("1,5", "1.5", "1 um,5 um"),
            ("1,5 um", "1.5 um", "1 um,5 um"),
            ("0,5nm", "0.5nm", "0 nm,5 nm"),
        )
    ],
    (f"{CONTACT_UM} --force '1 mN'", "a force needs --shear-modulus or --young"),
    (f"{CONTACT} --force '1 mN' --shear-modulus 1", NO_UNIT),
    (f"{CONTACT} --force 1 --shear-modulus '1 um'", "--shear-modulus"),
    (
        f"{CONTACT} --depth 1e300",
        "contact at depth 1e+300: larger than 1e+25 times the largest initial gap, up to which depths are allowed",
    ),
    (f"{CONTACT} --force 1 --shear-modulus 1 --young 1", EXCLUDE),
    (f"{CONTACT} --force 1 --shear-modulus 1 --poisson 0.3", "--poisson is for use with --young"),
    (f"{CONTACT} --force 1 --young 1 --poisson 0.6", "0.6 is not in the range -1<x<=0.5"),
    (f"{CONTACT} --force 1 --threads 0", "'--threads': 0 is not in the range 1<=x<=1024"),
    (f"{KINETICS} --viscosity 1", "exactly one of --force, --force-history and --depth-history is needed"),
    (f"{KINETICS} --depth-history force.csv --viscosity 1 -o force.csv", "would replace the depth history"),
    (f"{KINETICS} --force 1", "one of --viscosity and --medium is needed"),
    ("kinetics curve.nc --force 1 --viscosity 1 -o pipe.nc", "pipe"),
    ("kinetics map.nc --force 1 --viscosity 1 -o out.nc", "map.nc: no numbers depth(level)"),
    (f"{KINETICS} --force '1 N' --viscosity 1", f"--force 1 N: {NO_UNIT}"),
    (f"{KINETICS} --force 1 --viscosity '1 Pa s'", f"--viscosity 1 Pa s: {NO_UNIT}"),
    (f"{KINETICS} --force 1 --medium none.yaml", "none.yaml: not readable (No such file or directory)"),
    (
        f"{KINETICS} --force 1 --medium '2 kPa s'",
        "2 kPa s is no file; for a viscosity, --viscosity '2 kPa s' is needed",
    ),
    (f"{KINETICS} --force 1 --medium medium.yaml -o link.nc", "would replace the medium"),
    (f"{KINETICS} --force 1 --viscosity 1 -o curve.nc", "would replace the curve"),
    (f"{CONTACT_UM} --force 1 --young 1e-320", "too small"),
    (f"{ESTIMATE} --rms '1 um' --force 1 --viscosity 1", "one has a unit; both or none is allowed"),
    (f"{ESTIMATE} --rms 1 --force 1 --viscosity 1e-320", "--viscosity: 1e-320; allowed"),
    (f"{ESTIMATE} --rms 1 --force 1e30 --viscosity 1", "--times: X = F·J(t)/(4hL) is"),
    (f"{ESTIMATE.replace('0.8', '0.05')} --rms 1 --force 1 --viscosity 1", "--hurst: must be from 0.1 to 1"),
    (f"{GENERATE} --elements 5 --roll-off 0.01", "--roll-off: must leave at least one wave"),
    (f"{CONTACT.replace('--spacing 1', '--spacing 1e-170')} --depth 1", "contact: a spacing of 1e-170 is too small to"),
    (
        f"{KINETICS} --force 1e6 --viscosity 1 --times 1e6",
        "indent further, with --until-fraction 1 or, in units of F/G, --until-force ",
    ),
    *[
        (f"{KINETICS} --force 1 --viscosity 1 --times {times}", "FIRST:LAST:COUNT, as 0:4:201, needs 0 <= FIRST < LAST")
        for times in ("0:1", "1:0:3", "0:1:2.5")
    ],
    (f"{KINETICS} --force 1e-320 --viscosity 1", "--times: missing, and the creep is"),
    (f"{KINETICS} --depth-history deep.csv --viscosity 1", "load: the depth 4e+06 is beyond the curve's last level"),
    (GENERATE, "either --elements (a disc) or --points (a line) is needed"),
    (f"{GENERATE} --elements 5 --plateau", "--plateau is for use with --roll-off"),
    (f"{MARCH} events", "one of --times and --force-history is needed"),
    (f"{MARCH} implicit --times 1 --until-fraction 0.1", "--until-fraction is not for"),
    (f"{MARCH} euler --times 1", "'euler' is not one of 'events', 'implicit'"),
    (f"{MARCH} events --medium medium.yaml --times 1 --viscosity 2", "--medium replaces --viscosity"),
    ("reduce line.npy -o out.nc", "line.npy: the file states no unit of length; --unit, as --unit um, is needed, and"),
    *[
        (f"{MARCH} {method} --force 1e300 --viscosity 1e-300 --times 1", "depths or forces overflow")
        for method in ("events", "implicit")
    ],
    ("reduce text.npy --spacing 1 --unit 1 -o out.nc", "text.npy: indenter heights: an array of <U1; real numbers"),
    ("reduce line.npy --spacing 1 --unit 1 --realizations 2 -o out.nc", "--realizations and --seed are for maps"),
    ("reduce line.npy --spacing 1 --unit 1 --flip -o out.nc", "--channel and preparation are for maps"),
    ("reduce heights.npy --spacing 1 --unit 1 --realizations 2 -o a.csv", "several curves are no table"),
    (INDENT.replace("--unit 1", ""), "states no unit of length; --unit, as --unit um, is needed, or --unit 1 for"),
    ("plot heights.npy --unit um -o out.png", "points is not stated; --spacing is needed\n"),
    ("plot other.nc -o out.png", "other.nc: no heights, contact, curve or motion in it"),
    ("plot curve.nc -o link.png", "would replace the results"),
    *[
        (f"plot heights.npy -o out.png --unit 1 --spacing '{text}'", "--spacing")
        for text in ("", "1,2,3", "1 V", "1 um")
    ],
    ("plot heights.npy -o out.png --unit 1 --spacing 1,-1", "spacing: must be a positive number"),
    ("plot heights.npy -o out.png --spacing 1 --unit V", "unit 'V': not a unit"),
    *[(f"{INDENT} --nodata '{value}'", f"--nodata {value}") for value in ("a", "1,")],
    *[(f"{INDENT} --crop '{crop}'", f"--crop {crop}") for crop in ("1:2", "-1:2,0:3")],
    (f"{INDENT} --channel height", "--channel height"),
    ("indent um.nc --channel y -o out.nc", "heights have the shape (9,)"),
    (f"{INDENT} --scale much", "--scale much"),
    *[(line, "not readable (it is a pipe); ") for line in OF_PIPES],
    *[(f"{WRITERS[0]} -o {name}", f"{name}: {KIND} {RESULTS}") for name in ("out.txt", "out", "-")],
    *[(f"{line} -o out.xlsx", f"out.xlsx: {KIND} {RESULTS}") for line in WRITERS],
    (f"{MAP} -o out.csv", f"out.csv: {KIND} .nc (NetCDF)"),
    ("plot curve.nc -o out.nc", f"out.nc: {KIND} .png (picture), .pdf (drawing), .svg (drawing)"),
]


@pytest.mark.parametrize(("line", "what"), MISTAKES)
def test_mistakes_are_one_line(here, complaint, line, what):
    np.save("heights.npy", sphere_heights(9))
    np.save("line.npy", np.arange(3.0))
    np.save("text.npy", np.array(["a"]))
    viscorough.save(random_curve(length_unit="1"), "curve.nc")
    viscorough.save(Indenter(sphere_heights(9), 1.0), "map.nc")
    save_in("um", Indenter(1e-6 * sphere_heights(9), 1e-6, length_unit="m"), "um.nc")
    write("other.nc", {"a": (("b",), np.arange(3.0), {"long_name": "a", "units": "1"})}, {})
    (here / "medium.yaml").write_text("{kind: newtonian, viscosity: 30}")
    (here / "table.csv").write_text("0,0\n1e-6,1e-12\n")
    (here / "deep.csv").write_text("time,depth\n0,0\n1,1e6\n2,2e6\n3,3e6\n4,4e6\n")
    (here / "force.csv").write_text("time,force\n0,0\n1,0.2\n2,0.4\n")
    (here / "link.csv").symlink_to("force.csv")
    (here / "link.nc").symlink_to("medium.yaml")
    (here / "link.png").symlink_to("curve.nc")
    for suffix in ("", ".nc", ".csv", ".npy", ".yaml"):
        os.mkfifo(f"pipe{suffix}")
    assert what in complaint(line)
