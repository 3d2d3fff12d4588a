"""Run the blocks of code of a page in the working directory."""

import contextlib
import glob
import io
import os
import re
import shlex
import subprocess
import sys
import warnings
from pathlib import Path

from support.documentation import MAKEFILES
from viscorough.cli import main


def run_python(text, page, line, names):
    """Run a block of Python at a line of a page; names : global names, which the blocks of a page share."""
    exec(compile("\n" * line + text, page, "exec"), names)


def run_command(line):
    """Run a command of viscorough, and return its output."""
    command, *words = shlex.split(line, comments=True)
    arguments = [argument for word in words for argument in sorted(glob.glob(word)) or [word]]  # as a shell does
    as_for_users = warnings.catch_warnings(action="default")
    with as_for_users, contextlib.redirect_stdout(io.StringIO()) as printed:
        assert (command, main(arguments)) == ("viscorough", 0), line
    return printed.getvalue()


def run_console(text):
    """Run the lines that start with "$". Their output must match the lines below, in which ... matches any text."""
    for line, expected in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE):
        printed = run_command(line)
        pattern = ".*".join(re.escape(piece) for piece in expected.split("..."))
        assert re.fullmatch(pattern, printed), printed


def run_shell(text):
    """Run the lines that call viscorough. Lines of make must name targets; lines that install or test are left out."""
    for line in text.splitlines():
        program, *arguments = shlex.split(line, comments=True)
        if program == "make":
            targets = [argument for argument in arguments if "=" not in argument]
            assert all(re.search(rf"^{target}:", MAKEFILES, re.MULTILINE) for target in targets), line
        elif program == "for":
            path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
            subprocess.run(["bash", "-c", line], check=True, capture_output=True, env=os.environ | {"PATH": path})
        elif program not in ("pip", "python", "python3", "snakemake"):
            run_command(line)
