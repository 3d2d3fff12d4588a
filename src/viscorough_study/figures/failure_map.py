"""Failure map: error and verdict of every method in every stress-test case that applies to it."""

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import LogNorm
from matplotlib.patches import Rectangle
from matplotlib.transforms import ScaledTranslation

from viscorough_study.figures import style

MEANINGS = {
    "holds": "within the limit of the method",
    "model": "model, within a factor of two",
    "stated": "model outside its stated range",
    "warned": "wrong, with a warning",
    "refused": "refused, with a reason",
    "unnoticed": "wrong without notice",
}
LETTERS = {verdict: verdict[0].upper() for verdict in MEANINGS}
KINDS = {  # {kind of method: prefixes of the methods' names}
    "elastic path": ("path",),
    "direct integration": ("events", "explicit", "heun", "implicit"),
    "media": ("media",),
    "models": ("MDR", "power law"),
}
OTHER_KIND = "other methods"
# {difficulty that affects only some methods: prefixes of their names}
CONCERNED = {
    "step size": ("explicit steps",),
    "force in time": ("explicit steps",),
    "tolerance": ("path",),
    "medium": ("media",),
}
GROUP_NAMES = {"ties": "equal\nheights", "Hurst exponent": "Hurst\nexponent", "force in time": "force\nin time"}
FLOOR = 1e-16  # smaller errors are drawn at this value
NORM = LogNorm(FLOOR, 10)
HEADER = 68  # height in points of the rotated names of the methods above the cells


@style.figure
def plot_failure_map(table):
    """Error, as colour and number, and verdict, as letter, of every method (columns) in every case (rows).

    table : of viscorough_study.robustness.failure_map
    Methods are grouped by kind. A cell is blank where the difficulty does not apply to the method, unless the method
    refuses the case or fails unnoticed.
    """
    methods = sorted(dict.fromkeys(table["method"]), key=lambda name: [*KINDS, OTHER_KIND].index(_kind(name)))
    rows = list(dict.fromkeys(zip(table["group"], table["case"], strict=True)))
    figure = style.new_figure(3.7 * len(rows) + 58)
    axes = figure.subplots()
    errors = np.full((len(rows), len(methods)), np.nan)
    for cell in table.itertuples():
        i, j = rows.index((cell.group, cell.case)), methods.index(cell.method)
        if not _concerns(cell):
            continue
        if cell.verdict == "refused":
            axes.add_patch(Rectangle((j - 0.5, i - 0.5), 1, 1, color=style.PALE, linewidth=0))
        else:
            errors[i, j] = max(cell.error, FLOOR)
        color = "white" if NORM(errors[i, j]) < 0.55 else "black"
        axes.text(j, i, _cell_text(cell), ha="center", va="center", color=color)
    image = axes.imshow(errors, cmap=colormaps["cividis"], norm=NORM, aspect="auto")
    headers = [name.removeprefix("path, ").removeprefix("media, ") for name in methods]
    axes.set_xticks(range(len(methods)), headers, rotation=90)
    axes.set_yticks(range(len(rows)), [name for _, name in rows])
    axes.tick_params(which="both", length=0, top=False, labeltop=True, labelbottom=False, right=False)
    axes.minorticks_off()
    _name_kinds(axes, [_kind(name) for name in methods])
    _name_groups(axes, [group for group, _ in rows], len(methods) - 0.4)
    bar = figure.colorbar(image, ax=axes, location="bottom", aspect=60, shrink=0.8, pad=0.01, fraction=0.02)
    bar.set_label("largest relative error")
    meanings = [f"{letter}: {MEANINGS[verdict]}" for verdict, letter in LETTERS.items()]
    handles = [style.handle(text, linestyle="") for text in (*meanings, "blank: cannot matter")]
    figure.legend(handles=handles, loc="outside lower center", ncols=3, handlelength=0, handletextpad=0)
    return figure


def _kind(method):
    """Kind of a method, from its name."""
    return next((kind for kind, names in KINDS.items() if method.startswith(names)), OTHER_KIND)


def _concerns(cell):
    """Whether the difficulty of a case applies to the method, or the method refuses it or fails unnoticed."""
    names = CONCERNED.get(cell.group)
    return names is None or cell.method.startswith(names) or cell.verdict in ("refused", "unnoticed")


def _cell_text(cell):
    """Error to one digit and letter of the verdict; for a refusal only the letter."""
    if cell.verdict == "refused":
        return LETTERS["refused"]
    number = f"{cell.error:.0e}".replace("e-0", "e-").replace("e+00", "").replace("e+0", "e")
    return f"{number if cell.error else 0} {LETTERS[cell.verdict]}"


def _name_kinds(axes, kinds):
    """Label the kinds of methods above their columns and draw white lines between columns, thick between kinds."""
    upwards = ScaledTranslation(0, HEADER / 72, axes.get_figure().dpi_scale_trans)
    above = {"transform": axes.get_xaxis_transform() + upwards, "clip_on": False}
    for column in range(1, len(kinds)):
        axes.axvline(column - 0.5, color="white", linewidth=0.6 if kinds[column] == kinds[column - 1] else 2)
    for kind in dict.fromkeys(kinds):
        first, last = kinds.index(kind), kinds.index(kind) + kinds.count(kind) - 1
        axes.plot([first - 0.4, last + 0.4], [1, 1], color=style.BLACK, linewidth=0.6, **above)
        axes.text((first + last) / 2, 1, kind, ha="center", va="bottom", **above)


def _name_groups(axes, groups, x):
    """Label the groups of rows at x and draw white lines between them."""
    for group in dict.fromkeys(groups):
        first = groups.index(group)
        if first:
            axes.axhline(first - 0.5, color="white", linewidth=1.5)
        middle = first + (groups.count(group) - 1) / 2
        axes.text(x, middle, GROUP_NAMES.get(group, group), va="center")
