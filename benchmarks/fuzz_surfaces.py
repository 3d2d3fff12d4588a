"""Random surfaces in text and TIFF files, and options to read and prepare them; strategies for fuzz_cases.py."""

import io

import numpy as np
import tifffile
from hypothesis import strategies as st

HEADERS = [
    *[""] * 8,
    *["# Width: 4 um\n# Height: 3 um\n# Value units: nm\n", "# Width: 1 V\n# Height: 0\n", "pixel size = 1e-6 m\n"],
    *[
        "# x [um], y [um], z [nm]\n",
        "x,y,z\n",
        "# dx = 2\n# dy = 9\n",
        "# unit: \x00\n",
        "height conversion factor (-> m)=2\n",
    ],
]
FIELDS = st.one_of(
    st.integers(0, 9).map(str),
    st.floats(-5, 5).map(repr),
    st.sampled_from(["nan", "***", "", "1e400", "-9999", "1,5", "1_0", "x", "٣", "#", "1d3", "--", "0x1"]),
)


@st.composite
def texts(draw):
    """Matrices with a header or none, most of them whole, and ESRI grids."""
    rows, columns = draw(st.integers(1, 5)), draw(st.integers(1, 5))
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    table = [[f"{value:.4g}" for value in row] for row in random.standard_normal((rows, columns))]
    if draw(st.integers(0, 3)) == 0:
        table[draw(st.integers(0, rows - 1))] = draw(st.lists(FIELDS, max_size=5))
    head = draw(st.sampled_from(HEADERS))
    if draw(st.integers(0, 5)) == 0:
        count = draw(st.sampled_from([str(rows), "0", "-1", "1e400", "nan"]))
        head = f"ncols {columns}\nnrows {count}\ncellsize {draw(FIELDS)}\nNODATA_value {draw(FIELDS)}\n"
    text = head + "\n".join(draw(st.sampled_from([" ", ",", ";", "\t", ", "])).join(row) for row in table)
    return text.encode(draw(st.sampled_from(["utf-8", "utf-8", "utf-16"])))


@st.composite
def points(draw):
    """Columns x, y, z of a grid in any order, some with points missing, twice or off the grid."""
    rows, columns = draw(st.integers(1, 4)), draw(st.integers(1, 4))
    table = [f"{draw(st.just(x))} {0.5 * y} {(x * y) % 3}" for y in range(rows) for x in range(columns)]
    table = draw(st.permutations(table))
    for _ in range(draw(st.sampled_from([0, 0, 1, 2]))):
        table[draw(st.integers(0, len(table) - 1))] = " ".join(draw(st.lists(FIELDS, min_size=2, max_size=4)))
    return (draw(st.sampled_from(HEADERS)) + "\n".join(table)).encode()


@st.composite
def tiffs(draw, arrays):
    """TIFF files of one page or two, with the tags of GeoTIFF or without."""
    heights = draw(arrays)
    tags = []
    if draw(st.booleans()):
        number = st.sampled_from([0.0, 1.0, 1.0, 2.0, -1.0, np.nan, 1e300])
        keys = [1024, 0, 1, draw(st.sampled_from([1, 1, 2, 9])), 3076, 0, 1, draw(st.sampled_from([9001, 9002, 7]))]
        tags = [(33550, "d", 3, (draw(number), draw(number), 0.0), True)]
        tags += [(34735, "H", 12, [1, 1, 0, 2, *keys], True)]
        tags += [(42113, "s", 0, draw(st.sampled_from(["0", "nan", "x", "-9999"])), True)]
    file = io.BytesIO()
    try:
        tifffile.imwrite(file, heights, extratags=tags, photometric="minisblack")
    except Exception:  # types and shapes that the format lacks
        tifffile.imwrite(file, np.zeros((2, 2)))
    return file.getvalue()


OPTIONS = {
    "--unit": st.sampled_from(["um", "nm", "m", "1", "kg", "", "1e-6 m", "µm", "9**9**9", "\x00"]),
    "--channel": st.sampled_from(["0", "1", "z", "heights", "", "λ"]),
    "--nodata": st.sampled_from(["0", "-9999", "1e38", "nan", "", "0,1,2", "a"]),
    "--crop": st.sampled_from(["0:2,0:2", "0:1,0:1", "1:3,0:2", "2:1,0:1", "0:99,0:99", "", "a"]),
    "--detrend": st.sampled_from(["none", "mean", "plane", "sphere", "cubic"]),
    "--fill": st.sampled_from(["none", "harmonic", "linear"]),
}
SPACINGS = st.sampled_from(["1", "0.5", "1,2", "2,0.5", "1,9", "1 um", "500 nm,0.5 um", "1 V", ",", "1,2,3"])
READ = ["heights.txt", "heights.csv", "heights.asc", "heights.xyz", "heights.tif"]
