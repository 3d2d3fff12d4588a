"""Run the command line in this process, the installed command or Python in a new one; heights of a sphere."""

import os
import shlex
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np

from viscorough.cli import main
from viscorough.cli.files import with_lengths_in
from viscorough.io import netcdf
from viscorough.io.saving import to_content

VISCOROUGH = Path(sys.executable).with_name("viscorough")
RADIUS = 100.0


def run(line):
    """Return the exit code of a line of arguments; warnings are no errors, as for users."""
    with warnings.catch_warnings(action="default"):
        return main(shlex.split(line))


def values(path):
    """Return {name: values} of the variables in a NetCDF file."""
    return {name: each for name, (_, each, _) in netcdf.read(path)[0].items()}


def save_in(unit, result, path):
    """Write a result of the library, whose lengths are in metres, with lengths in another unit, as commands do."""
    variables, attributes = to_content(result)
    netcdf.write(path, with_lengths_in(variables, unit), attributes)


def python(*arguments, **environment):
    """Run Python with these arguments and environment variables, and require that it ends without an error."""
    options = {"capture_output": True, "text": True, "timeout": 120, "env": os.environ | environment}
    done = subprocess.run([sys.executable, *arguments], check=False, **options)
    assert done.returncode == 0, done.stderr
    return done


def sphere_heights(points=61):
    """Return a cap of a sphere of radius 100 spacings, shape (points, points), nan outside a disc."""
    position = np.arange(points) - (points - 1) / 2
    squared = position[:, None] ** 2 + position**2
    return np.where(squared <= position[-1] ** 2, -squared / (2 * RADIUS), np.nan)
