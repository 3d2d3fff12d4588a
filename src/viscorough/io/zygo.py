"""Read Zygo's XYZ data files: a fixed header, a line "#", and lines "column row height" or "column row No Data"."""

from collections.abc import Sequence

import numpy as np

from viscorough.io.scan import Scan


def zygo_scan(lines: Sequence[str]) -> Scan:
    """Return heights and spacing, as a Scan, from the lines of an XYZ data file of Format 1.

    Line 4 of the header holds the origin and size of the map in points. The seventh number of line 8 is the spacing in
    metres, 0 if it is not known. Heights are commonly in micrometres, but the file does not state their unit. Points
    without a line are missing. A second line "#" ends the points.

    Raises ValueError for lines that do not have this form.
    """
    try:
        left, top, columns, rows = map(int, lines[3].split()[:4])
        spacing = float(lines[7].split()[6])
        start = next(number for number, line in enumerate(lines) if line.strip() == "#") + 1
    except (ValueError, IndexError, StopIteration) as error:
        text = "no header of a Zygo XYZ file; lines 4 and 8 of its form, and a line '#', are needed"
        raise ValueError(text) from error
    if not (0 < columns <= 1_000_000 and 0 < rows <= 1_000_000 and columns * rows <= 100_000_000):
        raise ValueError(f"line 4: {columns} columns and {rows} rows; from 1 to 100 million points are needed")
    heights, seen = np.full((rows, columns), np.nan), np.zeros((rows, columns), dtype=bool)
    for number, line in enumerate(lines[start:], start + 1):
        words = line.split()
        if not words or words == ["#"]:
            continue
        try:
            row, column = int(words[1]) - top, int(words[0]) - left
            if not (0 <= row < rows and 0 <= column < columns) or seen[row, column]:
                raise ValueError
            heights[row, column] = np.nan if words[2:] == ["No", "Data"] else float(*words[2:])
            seen[row, column] = True
        except (ValueError, IndexError, TypeError) as error:
            needed = f"column, row and height of one of {columns} by {rows} points are needed"
            raise ValueError(f"line {number} ({line[:40]!r}); {needed}") from error
    if not seen.all() and lines[start:].count("#") != 1:
        raise ValueError(f"the closing line '#' lacks, and {seen.size - seen.sum()} points do; a whole file is needed")
    stated = (spacing, spacing) if spacing > 0 else None
    return Scan(heights, spacing=stated, spacing_unit="m" if stated else "1")
