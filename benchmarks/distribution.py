"""Build sdist and wheel, and run README's examples from the wheel in an empty environment.

    python benchmarks/distribution.py --output build/dist

The wheel is built from the sdist, and the sdist from a copy of the sources without files of earlier builds. Its
requirements are installed in the versions of requirements.lock, from a package index. README's lines in Python and
every example then run in an empty folder, where they must make a figure.
"""

import os
import re
import shutil
import subprocess
import sys
import venv
from pathlib import Path
from tempfile import TemporaryDirectory

import click

ROOT = Path(__file__).resolve().parents[1]
BUILD_SDIST = "import sys, setuptools.build_meta as backend; backend.build_sdist(sys.argv[1])"


def build(folder):
    """Build sdist and wheel in a folder, and return their paths."""
    folder = Path(folder).resolve()
    with TemporaryDirectory() as copy:
        for name in ("pyproject.toml", "README.md", "LICENSE"):
            shutil.copy(ROOT / name, copy)
        shutil.copytree(ROOT / "src", Path(copy, "src"), ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
        subprocess.run([sys.executable, "-c", BUILD_SDIST, folder], cwd=copy, check=True, capture_output=True)
    (sdist,) = folder.glob("*.tar.gz")
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "--no-index"]
    subprocess.run([*command, "--wheel-dir", folder, sdist], check=True)
    (wheel,) = folder.glob("*.whl")
    return sdist, wheel


def scripts():
    """Return {name: text} of README's lines in Python and of the examples."""
    (snippet,) = re.findall(r"^```python\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.M | re.S)
    return {"README": snippet} | {path.stem: path.read_text("utf-8") for path in (ROOT / "examples").glob("*.py")}


def run_all(wheel, folder):
    """Install the wheel in a new environment in a folder, and run every script there."""
    pins = re.findall(r"^[^\s#]+==[^\s;\\]+(?: ;[^\\]*)?", (ROOT / "requirements.lock").read_text("utf-8"), re.M)
    (folder / "constraints.txt").write_text("\n".join(pins), encoding="utf-8")
    venv.create(folder / "environment", with_pip=True)
    python = folder / "environment/bin/python"
    clean = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "VIRTUAL_ENV")}
    install = [python, "-m", "pip", "install", "--quiet", "-c", folder / "constraints.txt", f"{wheel}[plot]"]
    subprocess.run(install, env=clean, check=True)
    for name, text in scripts().items():
        place = folder / name
        place.mkdir()
        (place / f"{name}.py").write_text(text, encoding="utf-8")
        subprocess.run([python, f"{name}.py"], cwd=place, env=clean | {"MPLBACKEND": "agg"}, check=True)
        if not list(place.glob("*.png")):
            raise click.ClickException(f"{name}: made no figure")
        click.echo(f"{name} runs from the wheel")


@click.command(help=__doc__.splitlines()[0])
@click.option("--output", type=click.Path(path_type=Path), required=True, help="Folder of sdist and wheel.")
def main(output):
    shutil.rmtree(output, ignore_errors=True)
    output.mkdir(parents=True)
    sdist, wheel = build(output)
    click.echo(f"{sdist.name}, {wheel.name} of {wheel.stat().st_size} bytes")
    with TemporaryDirectory() as folder:
        run_all(wheel.resolve(), Path(folder))


if __name__ == "__main__":
    main()
