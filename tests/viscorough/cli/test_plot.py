"""`viscorough plot`: a figure of every kind of file, and refusals."""

import sys

import numpy as np
import pytest
from matplotlib import pyplot
from PIL import Image

import viscorough
from support.cf import violations
from support.command_line import run, sphere_heights
from viscorough.io import netcdf
from viscorough.io.datasets import read_dataset

MAP = "FOLDER/heights.npy --spacing 1 --unit 1"
SURFACE = "generate --hurst 0.7 --rms 1 --diameter 9 --seed 1"
FILES = {
    "curve.nc": f"indent {MAP}",
    "motion.nc": "kinetics FOLDER/curve.nc --force 1 --viscosity 1",
    "march.nc": f"march {MAP} --method events --times 1,2,3",
    "history.nc": f"march {MAP} --method events --force-history FOLDER/force.csv",
    "medium.nc": f"march {MAP} --method implicit --times 1,2,3 --medium FOLDER/medium.yaml",
    "disc.nc": f"{SURFACE} --elements 9 --unit um",
    "line.nc": f"{SURFACE} --points 64",
    "contact.nc": f"contact {MAP} --depth 0.01 --young 2",
    "contacts.nc": f"contact {MAP} --depth 0.01,0.02",
    "lines.nc": f"reduce {MAP} --realizations 3",
    "estimate.nc": "estimate --hurst 0.8 --rms 1e-6 --diameter 0.01 --force 10 --viscosity 1e6 --times 1e-9,1e-5,1e-4",
}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Make a folder with a file of every kind that can be drawn."""
    folder = tmp_path_factory.mktemp("made")
    np.save(folder / "heights.npy", sphere_heights(9))
    (folder / "force.csv").write_text("time,force\n0,1\n1,2\n2,2\n")
    (folder / "medium.yaml").write_text("{kind: maxwell, shear_modulus: 2, viscosity: 5}")
    for name, line in FILES.items():
        assert run(f"{line} -o FOLDER/{name}".replace("FOLDER", str(folder))) == 0
    return folder


@pytest.fixture
def here(made, here):
    for file in made.iterdir():
        (here / file.name).symlink_to(file)
    return here


@pytest.mark.parametrize("file", FILES)
def test_every_kind_of_file_is_drawn_and_follows_the_cf_conventions(made, here, capsys, file):
    """NetCDF files state neither time nor place of their making."""
    if file.endswith(".nc"):
        assert violations(file) == []
        _, attributes = netcdf.read(file)
        assert attributes["history"] == f"written by viscorough {viscorough.__version__}, with content_sha256"
        assert str(made) not in str(attributes)
    assert run(f"plot {file} -o figure.png") == 0
    captured = capsys.readouterr()
    assert captured.out == f"figure.png: figure of {file}\n"
    assert captured.err == ""
    with Image.open("figure.png") as picture:
        assert min(picture.size) > 400
        assert len(picture.convert("L").getcolors()) > 20


def axes_of(file):
    (axes, *_) = viscorough.plot(netcdf.read(file)).axes
    return axes.get_xlabel(), axes.get_ylabel()


def test_axes_are_in_si_units_with_a_modulus(here):
    """G = 2 MPa: G um2 is 2e-6 N."""
    assert run("indent disc.nc --shear-modulus '2 MPa' -o si_curve.nc") == 0
    (axes,) = viscorough.plot(netcdf.read("si_curve.nc")).axes
    assert axes_of("si_curve.nc") == ("depth (um)", "force F (N)")
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 2e6 * viscorough.load_curve("si_curve.nc").force)
    assert run("contact disc.nc --depth 0.3 --shear-modulus '2 MPa' -o si_fields.nc") == 0
    axes, colours = viscorough.plot(netcdf.read("si_fields.nc")).axes
    assert colours.get_ylabel() == "pressure p (Pa)"
    pressure = read_dataset("si_fields.nc").variables["pressure"].values
    np.testing.assert_allclose(axes.images[0].get_array(), 2e6 * pressure, rtol=1e-6)


def test_missing_matplotlib_is_one_line_that_names_the_extra(monkeypatch, complaint):
    monkeypatch.delattr("viscorough.io.plotting")
    monkeypatch.setitem(sys.modules, "viscorough.io.plotting", None)  # as if the import failed
    line = complaint("plot curve.nc -o figure.png")
    assert line == 'viscorough plot: matplotlib is not installed; pip install "viscorough[plot]" installs it\n'


def test_maps_have_the_first_row_at_the_top():
    surface = viscorough.Indenter(5e-9 * np.eye(5), 5e-5, 1e-5, length_unit="m")
    axes, colours = viscorough.plot(surface).axes
    assert (axes.get_xlabel(), axes.get_ylabel(), colours.get_ylabel()) == ("x (µm)", "y (µm)", "height (nm)")
    np.testing.assert_allclose(axes.images[0].get_extent(), [-125, 125, 25, -25])
    assert axes.images[0].origin == "upper"


def test_figures_can_be_shown(monkeypatch):
    """A figure is known to pyplot only when it is shown, so that pyplot does not keep all figures of a script."""
    shown = []
    monkeypatch.setattr(pyplot, "show", lambda: shown.append(pyplot.gcf()))
    figure = viscorough.plot(viscorough.Indenter(np.eye(5), 1.0))
    assert pyplot.get_fignums() == []
    figure.show()
    pyplot.close("all")
    assert shown == [figure]


@pytest.mark.parametrize("with_matplotlib", [True, False])
def test_notebooks_show_results_as_table_and_plot(monkeypatch, with_matplotlib):
    if not with_matplotlib:
        monkeypatch.delattr("viscorough.io.plotting")
        monkeypatch.setitem(sys.modules, "viscorough.io.plotting", None)
    curve = viscorough.indent(viscorough.Indenter(1e-6 * sphere_heights(17), 1e-6, length_unit="m"))
    html, (title, line, *_) = curve._repr_html_(), str(curve).splitlines()
    name, depth = "depth u", line.split(", ")[0].removeprefix("depth u ")
    assert html.startswith(f"<table><caption>{title}</caption><tr><td>{name}</td><td>{depth}</td></tr><tr>")
    assert ('<img src="data:image/png;base64,iVBOR' in html) == with_matplotlib
