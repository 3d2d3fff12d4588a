"""Files of instruments and other programs; their formats need the extra `formats`."""

import struct
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
import scipy.io

from support.contract import refused
from viscorough import AccuracyWarning, read_heights, read_line

SurfaceTopography = pytest.importorskip("SurfaceTopography", reason="the extra 'formats' is not installed")
FILES = Path(__file__).with_name("instrument_files")
pytestmark = pytest.mark.filterwarnings("ignore::viscorough.basics.errors.AccuracyWarning")


@pytest.mark.parametrize(
    ("name", "shape", "spacing", "unit"),
    [
        ("gwyddion-export-english.txt", (4, 3), (12.34e-6 / 3, 5678.9e-9 / 4), "m"),
        ("gwyddion-export-german.txt", (4, 3), (12.34e-6 / 3, 5678.9e-9 / 4), "m"),
        ("sdf-1.sdf", (4, 7), (1, 1), "um"),
        ("unnamed.ibw", (10, 10), (1, 1), "1"),
        ("top-1.top", (256, 256), (600 / 256, 600 / 256), "nm"),
    ],
)
def test_files_of_other_programs_are_read(name, shape, spacing, unit):
    """Heights, spacings and units agree with SurfaceTopography if it can read the file. Most are read without it."""
    reference = SurfaceTopography.read_topography(str(FILES / name))
    indenter = read_heights(FILES / name)
    assert indenter.heights.shape == shape
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx(spacing, rel=1e-12)
    assert indenter.length_unit == unit
    expected = np.ma.filled(np.ma.asarray(reference.heights(), dtype=float), np.nan).T
    np.testing.assert_allclose(indenter.heights, expected, rtol=1e-12)


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


@pytest.mark.parametrize("suffix", ["h5", "mat", "npz"])
def test_arrays_of_several_maps_are_listed(tmp_path, suffix):
    """Coordinates of one row or column do not count as maps."""
    path = tmp_path / f"a.{suffix}"
    arrays = {"first": MAP, "second": 2 * MAP, "x": np.arange(7.0)[None], "y": np.arange(5.0)[:, None]}
    if suffix == "h5":
        h5py = pytest.importorskip("h5py")
        with h5py.File(path, "w") as file:
            file.update(arrays)
    else:
        save = np.savez if suffix == "npz" else lambda path, **arrays: scipy.io.savemat(path, arrays)
        save(path, **arrays)
    with refused("it holds several arrays, 'first', 'second'; channel chooses one"):
        read_heights(path, 0.5, unit="um")
    second = read_heights(path, 0.5, unit="um", channel="second")
    np.testing.assert_array_equal(second.heights, 2 * MAP)
    assert (second.spacing, second.length_unit) == (0.5, "um")
    np.testing.assert_array_equal(read_heights(path, 1.0, channel="1").heights, 2 * MAP)
    with refused("spacing is needed"):
        read_heights(path, channel="second")
    with refused("no map of heights is called 'third'; .* are 'first', 'second'"):
        read_heights(path, 0.5, channel="third")


@pytest.mark.parametrize("suffix", ["mat", "npz"])
def test_the_only_map_among_coordinates_is_read(tmp_path, suffix):
    arrays = {"x": np.arange(7.0)[None], "y": np.arange(5.0)[:, None], "z": MAP, "date": 7.0}
    path = tmp_path / f"a.{suffix}"
    save = np.savez if suffix == "npz" else lambda path, **arrays: scipy.io.savemat(path, arrays)
    save(path, **arrays)
    np.testing.assert_array_equal(read_heights(path, 1.0).heights, MAP)


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
    with pytest.warns(AccuracyWarning, match="the channel 'Trace' is read; channel chooses another of 'Retrace'"):
        indenter = read_heights(path)
    np.testing.assert_array_equal(indenter.heights, MAP)
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2e-6, 3e-6))
    np.testing.assert_array_equal(read_heights(path, channel="Retrace").heights, 2 * MAP)


def test_gwyddion_fields_without_units_need_a_spacing(tmp_path):
    """Without a unit of length, the size of a field does not determine the spacing."""
    path = gwyddion(tmp_path / "a.gwy", ("Topo", MAP, None, None), mask=(MAP > 8e-8).astype(float))
    indenter = read_heights(path, 1.0, unit="nm")
    np.testing.assert_array_equal(indenter.heights, np.where(MAP > 8e-8, np.nan, MAP))
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (1.0, 1.0, "nm")
    with refused("spacing is needed"):
        read_heights(path, unit="nm")
    heights_only = gwyddion(tmp_path / "b.gwy", ("Topo", MAP, "", "m"))
    assert read_heights(heights_only, "5 um").spacing == pytest.approx(5e-6)
    lengths_only = gwyddion(tmp_path / "c.gwy", ("Topo", MAP, "m", ""))
    indenter = read_heights(lengths_only, unit="um")
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2, 3))
    two = gwyddion(tmp_path / "d.gwy", ("A", MAP, None, None), ("B", 2 * MAP, None, None), ("V", MAP, "m", "V"))
    with refused("its maps are 'A', 'B'; channel chooses one"):
        read_heights(two, 1.0)
    np.testing.assert_array_equal(read_heights(two, 1.0, channel="B").heights, 2 * MAP)
    with refused("it holds no map of heights"):
        read_heights(gwyddion(tmp_path / "e.gwy", ("V", MAP, "m", "V")), 1.0)


@pytest.mark.parametrize(("code", "kind"), [(3, "<f4"), (7, "<f8")])
def test_lowest_number_marks_missing_points(tmp_path, code, kind):
    heights = (10 * MAP / 1e-7).astype(kind)
    heights[2, 3] = np.finfo(kind).min
    header = struct.pack("<8s10s12s12sHH4dBBB", b"bISO-1.0", b"", b"", b"", 7, 5, 2e-7, 3e-7, 1e-8, 1e-9, 0, code, 0)
    (tmp_path / "a.sdf").write_bytes(header + heights.tobytes())
    indenter = read_heights(tmp_path / "a.sdf").to("m")
    heights[2, 3] = np.nan
    np.testing.assert_allclose(indenter.heights, 1e-8 * heights, rtol=1e-6)
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2e-7, 3e-7))


@pytest.mark.parametrize(("name", "text"), [("a", True), ("b", False)])
def test_sdf_files_of_the_dialect_bcr_are_read(tmp_path, name, text):
    heights = np.arange(20).reshape(4, 5) ** 2
    if text:
        keys = {"NumPoints": 5, "NumProfiles": 4, "Xscale": 2e-6, "Yscale": 3e-6, "Zscale": 1e-9, "Zresolution": -1}
        keys |= {"ManufacID": "x", "CreateDate": 1, "ModDate": 1, "Compression": 0, "DataType": 7, "CheckType": 0}
        rows = "\n".join(" ".join(map(str, row)) for row in heights)
        header = "\n".join(f"{key} = {value}" for key, value in keys.items())
        content = f"aBCR-1.0\n{header}\n*\n{rows}\n*\n".encode()
    else:
        header = b"bBCR-1.0", b"", b"", b"", 5, 4, 2e-6, 3e-6, 1e-9, -1.0, 0, 5, 0
        content = struct.pack("<8s10s12s12sHH4dBBB", *header) + heights.astype("<i2").tobytes()
    (tmp_path / f"{name}.sdf").write_bytes(content)
    indenter = read_heights(tmp_path / f"{name}.sdf").to("m")
    np.testing.assert_allclose(indenter.heights, 1e-9 * heights, rtol=1e-6)
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2e-6, 3e-6))


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
        (1, 1, "it holds a profile; read_line reads it"),
        (3, 1, "it holds a binary image; one surface is needed"),
        (5, 2, "it holds 2 objects, a series of surfaces; one surface is needed"),
        (2, 3, "it holds 3 objects, surfaces; one surface is needed"),
        (10, 1, "it holds an intensity image"),
        (99, 1, "it holds an object of kind 99"),
    ],
)
def test_objects_of_digital_surf_other_than_a_surface_are_refused(tmp_path, kind, objects, what):
    (tmp_path / "a.sur").write_bytes(digital_surf(np.arange(12).reshape(1 if kind == 1 else 3, -1), kind, objects))
    with refused(what):
        read_heights(tmp_path / "a.sur")


def test_digital_surf_files_of_a_surface_and_of_a_profile_are_read(tmp_path):
    heights = 100 * np.arange(12) ** 2
    (tmp_path / "a.sur").write_bytes(digital_surf(heights.reshape(3, 4), 2))
    surface = read_heights(tmp_path / "a.sur")
    np.testing.assert_allclose(surface.to("nm").heights, heights.reshape(3, 4), rtol=1e-5)
    (tmp_path / "a.pro").write_bytes(digital_surf(heights.reshape(1, 12), 1))
    line = read_line(tmp_path / "a.pro")
    np.testing.assert_allclose(line.to("nm").heights, heights, rtol=1e-5)
    assert line.to("um").spacing == pytest.approx(1)
    with refused("it holds|unknown kind of file"):
        read_line(tmp_path / "a.sur")
    (tmp_path / "two.sur").write_bytes(2 * digital_surf(heights.reshape(3, 4), 2))
    with refused("it holds 2 objects, surfaces"):
        read_heights(tmp_path / "two.sur")


def test_compressed_digital_surf_files_are_refused_by_name(tmp_path):
    (tmp_path / "a.sur").write_bytes(b"DSCOMPRESSED" + bytes(600))
    with refused("compressed Digital Surf files are not read; save it without compression"):
        read_heights(tmp_path / "a.sur")


def test_x3p_file_with_a_dash_in_its_revision_is_read(tmp_path):
    surface = SurfaceTopography.Topography(MAP.T, (7 * 2e-6, 5 * 3e-6), unit="m")
    surface.to_x3p(str(tmp_path / "plain.x3p"))
    for name, dash in (("en", "\u2013"), ("hyphen", "\u2010"), ("none", "-")):
        with zipfile.ZipFile(tmp_path / "plain.x3p") as plain, zipfile.ZipFile(tmp_path / f"{name}.x3p", "w") as file:
            for member in plain.namelist():
                content = plain.read(member)
                file.writestr(member, content.replace(b"ISO5436 - 2000", f"ISO5436 {dash} 2000".encode()))
        indenter = read_heights(tmp_path / f"{name}.x3p")
        np.testing.assert_array_equal(indenter.heights, MAP)
        assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2e-6, 3e-6), rel=1e-12)


def nms(path, step):
    """Write a NanoFocus file of 12 by 8 points, with heights from 2 to 6 um."""
    content = bytearray(3468 + 2 * 12 * 8)
    struct.pack_into("<2d", content, 16, 2.0, 6.0)
    struct.pack_into("<2I2d", content, 1368, 12, 8, step, step)
    struct.pack_into("<96H", content, 3468, *range(0, 96 * 600, 600))
    path.write_bytes(content)
    return path


@pytest.mark.parametrize("step", [312.5, 312.5e-6])
def test_the_spacing_of_nanofocus_files_is_in_nanometres_or_millimetres(tmp_path, step):
    indenter = read_heights(nms(tmp_path / "a.nms", step))
    assert indenter.heights.shape == (8, 12)
    assert (indenter.spacing, indenter.length_unit) == (pytest.approx(0.3125), "um")
    assert indenter.heights[0, 1] - indenter.heights[0, 0] == pytest.approx(4 * 600 / 65534)


@pytest.mark.parametrize(("step", "is_doubtful"), [(2e-10, True), (2e-9, False), (0.1, False), (0.2, True)])
def test_field_of_unlikely_size_gives_a_warning(tmp_path, recwarn, step, is_doubtful):
    """The seven points per row span 1.4 nm, 14 nm, 0.7 m and 1.4 m."""
    SurfaceTopography.Topography(MAP.T * step, (7 * step, 7 * step), unit="m").to_x3p(str(tmp_path / "a.x3p"))
    read_heights(tmp_path / "a.x3p")
    assert any("check the unit of the spacing" in str(warning.message) for warning in recwarn) is is_doubtful


@pytest.mark.parametrize("name", ["a.mat", "a.npz", "a.bin", "a.h5"])
def test_arrays_have_rows_along_y(tmp_path, name):
    heights = np.random.default_rng(1).random((3, 5))
    with open(tmp_path / name, "wb") as file:
        if name == "a.mat":
            scipy.io.savemat(file, {"heights": heights})
        elif name == "a.npz":
            np.savez(file, heights=heights)
        elif name == "a.bin":
            np.save(file, heights)
        else:
            h5py = pytest.importorskip("h5py")
            with h5py.File(file, "w") as content:
                content["heights"] = heights
    np.testing.assert_array_equal(read_heights(tmp_path / name, 1.0).heights, heights)


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


def test_contents_decide_if_formats_share_a_suffix(tmp_path):
    """Some instruments write binary files with the suffix .dat; other files with it are read as text."""
    (tmp_path / "a.dat").write_text("1 2\n3 4\n")
    assert read_heights(tmp_path / "a.dat", (1.0, 1.0)).heights.tolist() == [[1, 2], [3, 4]]
    (tmp_path / "b.dat").write_bytes((FILES / "unnamed.ibw").read_bytes())
    assert read_heights(tmp_path / "b.dat").heights.shape == (10, 10)
