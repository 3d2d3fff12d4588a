"""The installed command, the command line within this process, Python in another one, and the heights of a sphere."""

import os
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np

from viscorough.cli import main
from viscorough.io import netcdf

VISCOROUGH = Path(sys.executable).with_name("viscorough")
RADIUS = 100.0


def run(line):
    """The exit code of a line of arguments."""
    return main(shlex.split(line))


def values(path):
    """{name: values} of the variables in a NetCDF file."""
    return {name: variable.values for name, variable in netcdf.read(path).variables.items()}


def python(*arguments, **environment):
    """A process of Python with these arguments and variables, which ends without an error."""
    options = {"capture_output": True, "text": True, "timeout": 120, "env": os.environ | environment}
    done = subprocess.run([sys.executable, *arguments], check=False, **options)
    assert done.returncode == 0, done.stderr
    return done


def sphere_heights(points=61):
    """Cap of a sphere of radius 100 spacings, shape (points, points), nan outside a disc."""
    position = np.arange(points) - (points - 1) / 2
    squared = position[:, None] ** 2 + position**2
    return np.where(squared <= position[-1] ** 2, -squared / (2 * RADIUS), np.nan)
