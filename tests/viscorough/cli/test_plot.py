"""`viscorough plot`: a figure of every kind of file, and refusals."""

import sys

import numpy as np
import pytest
from PIL import Image

import viscorough
from support.cf import violations
from support.command_line import run, sphere_heights
from viscorough.io import netcdf

MAP = "FOLDER/heights.npy --spacing 1"
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
    (folder / "force.csv").write_text("0,1\n1,2\n2,2\n")
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
        attributes = netcdf.read(file).attributes
        assert attributes["history"] == f"written by viscorough {viscorough.__version__}, with content_sha256"
        assert str(made) not in str(attributes)
    assert run(f"plot {file} -o figure.png") == 0
    captured = capsys.readouterr()
    assert captured.out == f"figure.png: figure of {file}\n"
    assert captured.err == ""
    with Image.open("figure.png") as picture:
        assert min(picture.size) > 400
        assert len(picture.convert("L").getcolors()) > 20


@pytest.mark.parametrize(
    ("file", "suffix", "start"),
    [("march.nc", "png", b"\x89PNG"), ("march.nc", "svg", b"<?xml"), ("heights.npy --spacing 1", "pdf", b"%PDF")],
)
def test_figures_are_reproducible_in_every_format(here, suffix, start, file):
    for name in ("a", "b"):
        assert run(f"plot {file} -o {name}.{suffix}") == 0
    content = (here / f"a.{suffix}").read_bytes()
    assert content == (here / f"b.{suffix}").read_bytes()
    assert content.startswith(start)


def axes_of(file):
    axes = viscorough.plot(netcdf.read(file)).axes
    return [text for panel in axes for text in (panel.get_xlabel(), panel.get_ylabel()) if text]


def test_axes_have_symbols_and_units(here):
    """In a medium, the force of a motion is a function of time, unlike F/G of a loading curve."""
    assert run("indent disc.nc --spacing 1 -o um_curve.nc") == 0
    texts = axes_of("um_curve.nc")
    assert texts[:2] == ["depth $u$ (µm)", "force $F/G$ (µm²)"]
    assert texts[-1] == "contact fraction"
    assert axes_of("motion.nc") == ["time $t$ (s)", "depth $u$", "time $t$ (s)", "velocity $v$ (s⁻¹)"]
    assert axes_of("disc.nc")[:2] == ["$x$ (µm)", "$y$ (µm)"]
    assert axes_of("medium.nc") == ["time $t$ (s)", "depth $u$", "time $t$ (s)", "velocity $v$ (s⁻¹)"]


def test_a_history_that_unloads_is_drawn_as_a_loop():
    curve = viscorough.indent(viscorough.self_affine_disc(0.7, 9, rms=0.1, seed=1))
    medium = viscorough.Maxwell(2.0, 5.0)
    for end, number in ((0.0, 3), (0.2, 2)):
        load = viscorough.Load([0.0, 1.0, 2.0], depth=[0.0, 0.1, end])
        motion = viscorough.kinetics(curve, load, medium, np.linspace(0.01, 2, 50))
        axes = viscorough.plot(motion).axes
        assert len(axes) == number
        if number == 3:
            assert axes[2].get_ylabel() == "force $F$"
            line = axes[2].lines[0]
            np.testing.assert_array_equal(line.get_xydata(), np.transpose([motion.depth, motion.force]))


def test_axes_are_in_si_units_with_a_modulus(here):
    """G = 2 MPa: G um2 is 2e-6 N and G um is 2 N/m."""
    assert run("indent disc.nc --shear-modulus '2 MPa' -o si_curve.nc") == 0
    curve, figure = viscorough.load_curve("si_curve.nc"), viscorough.plot(netcdf.read("si_curve.nc"))
    force, stiffness, _ = figure.axes
    assert axes_of("si_curve.nc")[:4] == ["depth $u$ (µm)", "force $F$ (N)", "force $F$ (N)", "stiffness $k$ (N/m)"]
    np.testing.assert_allclose(force.lines[0].get_ydata(), 2e-6 * curve.force)
    np.testing.assert_allclose(stiffness.lines[0].get_ydata(), 2 * curve.stiffness)
    assert run("contact disc.nc --depth 0.3 --shear-modulus '2 MPa' -o si_fields.nc") == 0
    figure, fields = viscorough.plot(netcdf.read("si_fields.nc")), netcdf.read("si_fields.nc").variables
    assert "pressure $p$ (MPa)" in axes_of("si_fields.nc")
    np.testing.assert_allclose(figure.axes[0].images[0].get_array(), 2 * fields["pressure"].values, rtol=1e-6)
    line = figure.subfigs[0].get_suptitle()
    assert f"contact area {float(fields['corrected_contact_area'].values):.4g} µm²" in line
    assert "F/G" not in line


def test_missing_matplotlib_is_one_line_that_names_the_extra(monkeypatch, complaint):
    monkeypatch.delattr("viscorough.io.plotting")
    monkeypatch.setitem(sys.modules, "viscorough.io.plotting", None)  # as if the import failed
    line = complaint("plot curve.nc -o figure.png")
    assert line == 'viscorough plot: matplotlib is not installed; pip install "viscorough[plot]" installs it\n'


def test_lengths_are_drawn_in_readable_units():
    """Positions reach 0.1 mm, and heights are nanometres; both are stored in m."""
    surface = viscorough.Indenter(5e-9 * np.eye(5), 5e-5, 1e-5, length_unit="m")
    axes, colours = viscorough.plot(surface).axes
    assert (axes.get_xlabel(), axes.get_ylabel(), colours.get_ylabel()) == ("$x$ (µm)", "$y$ (µm)", "height $z$ (nm)")
    np.testing.assert_allclose(axes.images[0].get_extent(), [-125, 125, 25, -25])
    assert axes.images[0].get_array().max() == pytest.approx(5)
    assert (axes.images[0].origin, axes.get_title()) == ("upper", "heights")


def test_results_are_drawn_from_python(here):
    """Every panel has a title. The colours of pressures end at a percentile that the figure names."""
    indenter = viscorough.Indenter(sphere_heights(17), 1.0, length_unit="um")
    curve, contact = viscorough.indent(indenter), viscorough.contact_at(indenter, depth=0.3, shear_modulus="2 MPa")
    motion = viscorough.kinetics(curve, "1 uN", "1 kPa s")
    for result in (indenter, curve, contact, motion):
        panels = [axes for axes in viscorough.plot(result).axes if axes.get_label() != "<colorbar>"]
        assert all(axes.get_title() for axes in panels)
    figure = viscorough.plot(contact, "contact.png")
    assert (here / "contact.png").exists()
    assert figure.axes[0].get_title() == "pressure, colours to the 99th percentile"
    limit = figure.axes[0].images[0].get_clim()[1]
    assert limit == pytest.approx(2 * np.percentile(contact.pressure[contact.contact], 99))  # MPa
