"""Cost of the loading curve of one disc on ever finer grids."""

COLUMNS = {
    "across": ("elements across the disc", "1"),
    "elements": ("elements of the disc", "1"),
    "levels": ("levels of its loading curve", "1"),
    "operator_applications": ("applications of the half-space operator", "1"),
    "wall": ("wall time", "s"),
    "processor": ("processor time", "s"),
    "memory": ("largest memory of the process", "B"),
    "machine": ("machine on which times and memory were measured", None),
}
