"""docs/output.md describes the files of the command line. Its rows on files of the workflow: tests/workflow."""

import netCDF4
import numpy as np

from support.command_line import run, sphere_heights
from support.documentation import ROOT, read
from support.output_files import documented

SURFACE = "--hurst 0.8 --rms 1e-6 --diameter 0.01"
COMMANDS = {
    "indent": "heights.npy --spacing 1 --unit 1 --shear-modulus 1",
    "kinetics": "indent.nc --force 1 --viscosity 1",
    "march": "heights.npy --spacing 1 --unit 1 --method events --times 1,2",
    "generate": f"{SURFACE} --elements 9 --seed 1",
    "estimate": f"{SURFACE} --force 10 --viscosity 1e9 --times 0.01,0.1",
}


def test_page_describes_the_files_of_the_command_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("heights.npy", sphere_heights(9))
    rows, curve = documented(read(ROOT / "docs/output.md")), set()
    for command, arguments in COMMANDS.items():
        assert run(f"{command} {arguments} -o {command}.nc") == 0
        (row,) = (row for name, row in rows.items() if name.endswith(f"viscorough {command}"))
        # a cell in words, such as "those of the curve" or "the coordinates"
        coordinates = {"generate": {"x", "y"}}.get(command, set())
        with netCDF4.Dataset(f"{command}.nc") as made:
            curve = curve or set(made.variables)
            assert set(made.dimensions) == set(row.dimensions)
            assert set(made.variables) == {*row.variables, *coordinates}
