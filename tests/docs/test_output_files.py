"""docs/output.md describes the files of the command line; those of the workflow are checked in tests/workflow."""

import netCDF4
import numpy as np
import pytest

from support.command_line import sphere_heights
from support.documentation import ROOT, read
from support.output_files import documented
from viscorough.cli import main

DISC = ["--hurst", "0.8", "--elements", "9"]
LAW = ["--hurst", "0.8", "--force", "10", "--viscosity", "1e9", "--times", "0.01,0.1"]
DOCUMENTED = documented(read(ROOT / "docs/output.md"))


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("files")
    np.save(folder / "heights.npy", sphere_heights(9))
    heights, curve = str(folder / "heights.npy"), str(folder / "curve.nc")
    for arguments in (
        ["indent", heights, "--spacing", "1", "-o", curve],
        ["kinetics", curve, "--force", "1", "--viscosity", "1", "-o", str(folder / "kinetics.nc")],
        ["march", heights, "--spacing", "1", "--method", "events", "-o", str(folder / "march.nc")],
        ["generate", *DISC, "--rms", "1e-6", "--diameter", "0.01", "--seed", "1", "-o", str(folder / "surface.nc")],
        ["estimate", *LAW, "--rms", "1e-6", "--diameter", "0.01", "-o", str(folder / "estimate.nc")],
    ):
        assert main(arguments) == 0
    return folder


@pytest.mark.parametrize(
    ("command", "file"),
    [
        *[("indent", "curve"), ("kinetics", "kinetics"), ("march", "march")],
        *[("generate", "surface"), ("estimate", "estimate")],
    ],
)
def test_files_of_the_command_line(files, command, file):
    (row,) = (row for name, row in DOCUMENTED.items() if name.endswith(f"viscorough {command}"))
    variables = set(row.variables)
    if command == "kinetics":  # "those of the curve, ..."
        variables |= set(next(row for name, row in DOCUMENTED.items() if "indent" in name).variables)
    if command == "generate":
        variables |= {"x", "y"}  # the coordinates
    with netCDF4.Dataset(files / f"{file}.nc") as made:
        assert set(made.dimensions) == set(row.dimensions)
        assert set(made.variables) == variables - {"force"} if command == "march" else variables
