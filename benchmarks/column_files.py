"""Random CSV files of force histories, creep tables and loading curves with units in their headings; for
file_campaign.py. Their truth is in s, N, 1/Pa, m and powers of m.
"""

import contextlib
import io
from pathlib import Path

import numpy as np
from file_cases import Draft
from text_files import encoded

from viscorough import cli
from viscorough.io import netcdf, tables
from viscorough.io.curves import curve_from_content
from viscorough.io.media import medium_from_mapping

TIMES = {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0, "µs": 1e-6}
FORCES = {"N": 1.0, "mN": 1e-3, "kN": 1e3, "µN": 1e-6}
COMPLIANCES = {"1/Pa": 1.0, "1/MPa": 1e-6, "Pa^-1": 1.0, "1/GPa": 1e-9}
LENGTHS = {"um": 1e-6, "nm": 1e-9, "m": 1.0, "mm": 1e-3}
HEADINGS = ("", "t,{f}", "time,value")
ODD_HEADINGS = ("t [{u}],{f} [{v}]", "t ({u}),{f} ({v})", "t/{u},{f}/({v})", "t in {u},{f} in {v}")
ODD_HEADINGS += ("# t [{u}],{f} [{v}]", "Zeit [{u}],Wert [{v}]", "t[{u}],{f}[{v}]")
# Units swapped, another one, one of pixels, one that nobody knows
BAD_HEADINGS = ("t [{v}],{f} [{u}]", "t [{u}],{f} [K]", "t [px],{f} [{v}]", "t [{u}],{f} [abc]")


def two_columns(random):
    """A force history or a creep table."""
    history = random.random() < 0.5
    draft = Draft("force history" if history else "creep table", random)
    u, v = draft.one_of(list(TIMES)), draft.one_of(list(FORCES if history else COMPLIANCES))
    heading = draft.pick(HEADINGS, ODD_HEADINGS, BAD_HEADINGS, odd=0.7)
    if "{u}" not in heading:
        u, v = "s", "N" if history else "1/Pa"
    count = int(draft.random.integers(2, 9))
    times = np.append(0, np.round(np.cumsum(draft.random.uniform(0.1, 2, count)), 4))
    rows = np.stack([times, np.round(2 - 1 / (1 + times), 8)], axis=1)  # a creep compliance that levels off
    lines = [f"{time:.4f},{value:.8f}" for time, value in rows]
    if draft.chance(0.1):
        draft.note("decimal commas", clear=False)
        lines = [line.replace(",", ";").replace(".", ",") for line in lines]
        heading = heading.replace(",", ";")
    lines = [heading.format(u=u, v=v, f="F" if history else "J")] * bool(heading) + lines
    factors = TIMES[u], (FORCES if history else COMPLIANCES)[v]
    content = encoded(draft, lines)
    if content[:2] in (b"\xff\xfe", b"\xfe\xff") or any(name in draft.traits for name in ("latin-1", "cp1252")):
        draft.clear = False
    return draft.case("columns.csv", content, rows * factors, None, ())


ABOUT = ("# elements: 99", "# operator_applications: 7", "# tolerance: 0.001", '# method: "loading path"')
COUNTS = ",contact_count,contact_fraction,residual"
CLEAR = "depth ({u}),force ({u}2),stiffness ({u})"
CONVERTED = "depth ({u}),force (m2),stiffness ({u})"
ODD_CURVES = ("depth [{u}],force [{u}2],stiffness [{u}]", "depth ({u}),force ({u}^2),stiffness ({u})")
ODD_CURVES += ("depth ({u}),force ({u}**2),stiffness ({u})", CONVERTED)
BAD_CURVES = ("depth ({u}),force ({o}2),stiffness ({u})", "depth ({u}),force ({u}2),stiffness ({o})")
BAD_CURVES += ("depth ({u}),force (N),stiffness ({u})", "depth ({u}),force,stiffness ({u})")
BAD_CURVES += ("depth (px),force (px2),stiffness (px)",)


def curve(random):
    """A loading curve as viscorough writes it, with units that agree or contradict each other."""
    draft = Draft("curve", random)
    heading = draft.pick([CLEAR], ODD_CURVES, BAD_CURVES, odd=0.6)
    u, o = draft.random.permutation(list(LENGTHS))[:2]
    depth = np.arange(1.0, draft.random.integers(3, 9))
    force = depth**2 / 2 * (LENGTHS[u] ** 2 if heading == CONVERTED else 1)
    lines = [*ABOUT, heading.format(u=u, o=o) + COUNTS]
    for level, (d, f) in enumerate(zip(depth.tolist(), force.tolist(), strict=True), 1):
        lines.append(f"{d!r},{f!r},{d!r},{level},{level / 99!r},0.0")
    truth = np.stack([depth * LENGTHS[u], depth**2 / 2 * LENGTHS[u] ** 2, depth * LENGTHS[u]], axis=1)
    return draft.case("curve.csv", "\n".join([*lines, ""]).encode(), truth, None, ())


# ---- the readers


def read_history(path):
    """Times and forces, as the command line reads them."""
    heading = CLEAR.format(u="m")
    (path.parent / "loading.csv").write_text("\n".join([*ABOUT, heading + COUNTS, "1e12,1e12,1.0,99,1.0,0.0", ""]))
    names = [str(path.parent / "loading.csv"), "--force-history", str(path), "--viscosity", "1", "-o"]
    with contextlib.redirect_stderr(io.StringIO()) as messages, contextlib.redirect_stdout(io.StringIO()):
        code = cli.main(["kinetics", *names, str(path.parent / "kinetics.nc")])
    if code:
        raise ValueError(messages.getvalue().strip().removeprefix("viscorough kinetics: "))
    variables = netcdf.read(path.parent / "kinetics.nc").variables
    return np.stack([variables["time"].values, variables["force"].values], axis=1)


def read_creep(path):
    medium = medium_from_mapping({"kind": "creep_table", "file": Path(path).name}, "m", folder=path.parent)
    return np.stack([medium.times, medium.compliances], axis=1)


def read_curve(path):
    try:
        loaded = curve_from_content(tables.read(path))
    except ValueError as error:  # as the command line names the file
        text = str(error)
        raise ValueError(text if text.startswith(str(path)) else f"{path}: {text}") from error
    metre = LENGTHS.get(loaded.length_unit, np.nan)
    return np.stack([loaded.depth * metre, loaded.force * metre**2, loaded.stiffness * metre], axis=1)


READERS = {"force history": read_history, "creep table": read_creep, "curve": read_curve}
