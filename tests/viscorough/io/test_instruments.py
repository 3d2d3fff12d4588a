"""Binary files of instruments, read by SurfaceTopography; other formats are refused, with lines that make a map."""

import re
import struct
import sys
from pathlib import Path

import numpy as np
import pytest

from support.contract import refused
from viscorough import AccuracyWarning, read_heights

SurfaceTopography = pytest.importorskip("SurfaceTopography", reason="the extra 'formats' is not installed")
FILES = Path(__file__).with_name("instrument_files")
pytestmark = pytest.mark.filterwarnings("ignore::viscorough.basics.errors.AccuracyWarning")


@pytest.mark.parametrize(
    ("name", "shape", "spacing", "metres"),
    [
        ("top-1.top", (256, 256), (600 / 256, 600 / 256), 1e-9),
    ],
)
def test_files_of_other_programs_are_read(name, shape, spacing, metres):
    reference = SurfaceTopography.read_topography(str(FILES / name))
    indenter = read_heights(FILES / name)
    assert indenter.heights.shape == shape
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx(np.multiply(spacing, metres), rel=1e-12)
    assert indenter.length_unit == "m"
    expected = np.ma.filled(np.ma.asarray(reference.heights(), dtype=float), np.nan).T
    np.testing.assert_allclose(indenter.heights, metres * expected, rtol=1e-12)


@pytest.mark.parametrize("suffix", ["x3p", "gwy"])
def test_formats_written_by_another_program_are_read(tmp_path, suffix):
    """Rows are along y, points without a measurement are nan, and both spacings are read, in metres."""
    heights = np.random.default_rng(1).random((6, 9)) * 1e-7
    measured = np.ma.masked_invalid(np.where(heights < 2e-8, np.nan, heights)) if suffix == "x3p" else heights
    surface = SurfaceTopography.Topography(measured.T, (9 * 2e-6, 6 * 3e-6), unit="m")
    getattr(surface, f"to_{suffix}")(str(tmp_path / f"a.{suffix}"))
    indenter = read_heights(tmp_path / f"a.{suffix}")
    np.testing.assert_allclose(indenter.heights, np.ma.filled(measured, np.nan), rtol=1e-6)
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2e-6, 3e-6), rel=1e-6)
    assert indenter.length_unit == "m"


MAP = 1e-7 * np.random.default_rng(1).random((5, 7))


def gwyddion(path, *fields, mask=None):
    """Write a Gwyddion file of maps of 2 by 3 um per point; fields are (title, heights, unit of x and y, unit of z)."""

    def part(name, kind, content):
        return name.encode() + b"\0" + kind.encode() + content

    def packed(name, parts):
        content = b"".join(parts)
        return name.encode() + b"\0" + struct.pack("<I", len(content)) + content

    def field(heights, lateral, unit):
        rows, columns = heights.shape
        numbers = struct.pack("<I", heights.size) + heights.astype("<f8").tobytes()
        parts = [part("xres", "i", struct.pack("<i", columns)), part("yres", "i", struct.pack("<i", rows))]
        parts += [
            part("xreal", "d", struct.pack("<d", 2e-6 * columns)),
            part("yreal", "d", struct.pack("<d", 3e-6 * rows)),
        ]
        for name, text in (("si_unit_xy", lateral), ("si_unit_z", unit)):
            if text is not None:
                parts.append(part(name, "o", packed("GwySIUnit", [part("unitstr", "s", text.encode() + b"\0")])))
        return packed("GwyDataField", [*parts, part("data", "D", numbers)])

    parts = []
    for number, (title, *content) in enumerate(fields):
        parts.append(part(f"/{number}/data/title", "s", title.encode() + b"\0"))
        parts.append(part(f"/{number}/data", "o", field(*content)))
    if mask is not None:
        parts.append(part("/0/mask", "o", field(mask, None, None)))
    path.write_bytes(b"GWYP" + packed("GwyContainer", parts))
    return path


def test_the_first_of_several_channels_of_an_instrument_is_read_with_a_warning(tmp_path):
    path = gwyddion(
        tmp_path / "a.gwy", ("Trace", MAP, "m", "m"), ("Phase", MAP, "m", "deg"), ("Retrace", 2 * MAP, "m", "m")
    )
    with pytest.warns(AccuracyWarning, match="'Trace' is read; argument channel chooses another of 'Retrace'"):
        indenter = read_heights(path)
    np.testing.assert_array_equal(indenter.heights, MAP)
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2e-6, 3e-6))
    np.testing.assert_array_equal(read_heights(path, channel="Retrace").heights, 2 * MAP)


def test_gwyddion_fields_without_units_are_refused(tmp_path):
    with refused("it holds no map of two dimensions with units of length"):
        read_heights(gwyddion(tmp_path / "a.gwy", ("Topo", MAP, None, None)), 1.0, unit="nm")


def test_distances_without_a_unit_need_a_spacing(tmp_path):
    with refused("the distance between neighbouring points is not stated; argument spacing is needed"):
        read_heights(FILES / "unnamed.ibw", unit="nm")
    assert read_heights(FILES / "unnamed.ibw", "20 nm", unit="um").spacing == pytest.approx(2e-8)


@pytest.mark.parametrize(("code", "kind"), [(3, "<f4"), (7, "<f8")])
def test_lowest_number_marks_missing_points(tmp_path, code, kind):
    heights = (10 * MAP / 1e-7).astype(kind)
    heights[2, 3] = np.finfo(kind).min
    header = struct.pack("<8s10s12s12sHH4dBBB", b"bISO-1.0", b"", b"", b"", 7, 5, 2e-7, 3e-7, 1e-8, 1e-9, 0, code, 0)
    (tmp_path / "a.sdf").write_bytes(header + heights.tobytes())
    indenter = read_heights(tmp_path / "a.sdf")
    heights[2, 3] = np.nan
    np.testing.assert_allclose(indenter.heights, 1e-8 * heights, rtol=1e-6)
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2e-7, 3e-7))


def digital_surf(heights, kind, objects=1, spacing=(1e-3, 2e-3)):
    """Return a Digital Surf file of heights in mm, stored as whole numbers of nm, with the spacings in mm."""
    rows, columns = heights.shape
    start = struct.pack("<12s4H78x", b"DIGITAL SURF", 0, objects, 1, kind)
    content = start + struct.pack("<Hiiiii3f", 32, 0, 0, columns, rows, heights.size, *spacing, 1e-6)
    content += b"".join(name.ljust(16) for name in (b"X", b"Y", b"Z", *[b"mm"] * 6)) + struct.pack("<3f", 1, 1, 1)
    return content.ljust(512, b"\0") + heights.astype("<i4").tobytes()


@pytest.mark.parametrize(
    ("kind", "objects", "what"),
    [
        (1, 1, "it holds an object of kind 1, not a surface; one surface is needed, so export it alone"),
        (5, 2, "it holds 2 objects"),
        (2, 3, "it holds 3 objects"),
        (10, 1, "it holds an object of kind 10, not a surface"),
    ],
)
def test_objects_of_digital_surf_other_than_a_surface_are_refused(tmp_path, kind, objects, what):
    (tmp_path / "a.sur").write_bytes(digital_surf(np.arange(12).reshape(1 if kind == 1 else 3, -1), kind, objects))
    with refused(what):
        read_heights(tmp_path / "a.sur")


def test_digital_surf_files_of_a_surface_are_read(tmp_path):
    heights = 100 * np.arange(12) ** 2
    (tmp_path / "a.sur").write_bytes(digital_surf(heights.reshape(3, 4), 2))
    surface = read_heights(tmp_path / "a.sur")
    np.testing.assert_allclose(1e9 * surface.heights, heights.reshape(3, 4), rtol=1e-5)
    (tmp_path / "two.sur").write_bytes(2 * digital_surf(heights.reshape(3, 4), 2))
    with refused("it holds 2 objects"):
        read_heights(tmp_path / "two.sur")


def made_map(error):
    """Run the lines of Python that a message shows, and return the map that they make."""
    exec(re.search(r"in Python: (.*)", str(error.value))[1], {})
    return read_heights("map.npy", 1.0).heights


@pytest.mark.parametrize("big", [False, True])
def test_tiff_is_refused_with_the_line_that_makes_a_map(tmp_path, monkeypatch, big):
    tifffile = pytest.importorskip("tifffile")
    monkeypatch.chdir(tmp_path)
    tifffile.imwrite("a.ome.tif", MAP, bigtiff=big)
    with refused("TIFF is not read; argument spacing then states the size of its pixels") as error:
        read_heights("a.ome.tif", "3 um")
    np.testing.assert_array_equal(made_map(error), MAP)


def test_text_is_never_given_to_surface_topography():
    """SurfaceTopography would guess the units of these files."""
    for name in ("gwyddion-export-english.txt", "gwyddion-export-german.txt", "sdf-1.sdf"):
        with refused("holds a unit or a number, which are not read from text|a matrix of numbers alone"):
            read_heights(FILES / name, 1.0)


def test_bad_files_are_one_line(tmp_path):
    (tmp_path / "noise.x3p").write_bytes(bytes(range(256)) * 4)
    (tmp_path / "square.raw").write_bytes(np.random.default_rng(1).bytes(2 * 50**2))
    (tmp_path / "empty.x3p").touch()
    (tmp_path / "cut.top").write_bytes((FILES / "top-1.top").read_bytes()[:9000])
    (tmp_path / "lines.sdf").write_text("1.0 2.0\n1.5 2.5\n2.0 3.0\n")
    for name in ("noise.x3p", "square.raw", "empty.x3p", "cut.top", "lines.sdf", "missing.plu"):
        with refused(name) as error:
            read_heights(tmp_path / name, 1.0)
        assert len(str(error.value)) < 400


def test_message_without_the_extra_names_the_remedy(tmp_path, monkeypatch):
    (tmp_path / "a.x3p").write_bytes(b"PK\x03\x04")
    monkeypatch.setitem(sys.modules, "SurfaceTopography.IO", None)  # as if it were not installed
    with refused(r'pip install "viscorough\[formats\]"'):
        read_heights(tmp_path / "a.x3p")
