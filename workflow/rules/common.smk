"""What rules are made from: tables of cases, inputs, params, source digests."""

import ast
import hashlib
import importlib.util
import itertools
import os
import subprocess
import sys
from functools import cache
from pathlib import Path

import yaml

from viscorough_study import seeds

# One thread per job: jobs run side by side. Numba heeds only its own variable.
os.environ.update(NUMBA_NUM_THREADS="1", OMP_NUM_THREADS="1")
# glibc gives large arrays back when they are freed and takes them anew, page by page: a fifth of the time of a line.
os.environ.update(MALLOC_MMAP_THRESHOLD_=str(2**25), MALLOC_TRIM_THRESHOLD_=str(10**9))
os.environ.setdefault("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1")  # large pages where the system has them

WORKFLOW = Path(workflow.basedir) / "workflow"
PACKAGES = Path(importlib.util.find_spec("viscorough").origin).parents[1]


# ---- tables of cases: floats never stand in file names


def hurst_id(hurst):
    """Name of a Hurst exponent in file names, such as h01000 for 0.1."""
    return f"h{round(hurst * 1e4):05d}"


def disc_cases(settings):
    """{case: group, spawn key, realizations, batch, elements, surface (arguments of self_affine_disc)} of every ensemble.

    To a spawn key the number of the realization is added: no position in a list, no batch and no order enters.
    """
    cases, unit = {}, {"rms": 1.0, "diameter": 1.0}
    for hurst in settings["discs"]["hurst"]:
        for each in settings["discs"]["combinations"]:
            cases[f"{hurst_id(hurst)}_c{each['number']}"] = {
                "group": "base",
                "spawn_key": list(seeds.disc_key(hurst, each["number"])),
                "combination": each,
                "surface": settings["surface"] | {"hurst": hurst, "rms": each["rms"], "diameter": each["diameter"]},
                **{name: settings["discs"][name] for name in ("elements", "realizations", "batch")},
            }
        for each in settings["variants"]["cases"]:
            changed = {name: value for name, value in each.items() if name != "name"}
            cases[f"{hurst_id(hurst)}_{each['name']}"] = {
                "group": each["name"],
                "spawn_key": list(seeds.variant_key(hurst, each["name"])),
                "surface": settings["surface"] | changed | unit | {"hurst": hurst},
                "elements": settings["discs"]["elements"],
                **{name: settings["variants"][name] for name in ("realizations", "batch")},
            }
    sizes = settings["sizes"]
    shared = {name: sizes[name] for name in ("realizations", "batch")}
    for hurst, elements in itertools.product(sizes["hurst"], sizes["elements"]):
        cases[f"{hurst_id(hurst)}_n{elements}"] = {
            "group": "sizes",
            "spawn_key": list(seeds.size_disc_key(hurst, elements)),
            "surface": settings["surface"] | unit | {"hurst": hurst},
            "elements": elements,
            **shared,
        }
    hurst = sizes["control"]["hurst"]
    for elements in sizes["elements"]:
        cases[f"{hurst_id(hurst)}_control_n{elements}"] = {
            "group": "controls",
            "spawn_key": list(seeds.size_control_key(hurst, elements)),
            "surface": settings["surface"] | unit | sizes["control"],
            "elements": elements,
            **shared,
        }
    return cases


def line_cases(settings):
    """{line: group, spawn key, realizations, batch, points, surface (arguments of self_affine_line)} of every ensemble."""
    shared = {name: settings["surface"][name] for name in ("amplitudes", "roll_off_wavelength", "roll_off_level")}
    shared |= {"rms": 1.0, "length": 1.0}
    cases = {
        hurst_id(hurst): {
            "group": "lines",
            "spawn_key": list(seeds.line_key(hurst)),
            "surface": shared | {"hurst": hurst},
            **{name: settings["lines"][name] for name in ("points", "realizations", "batch")},
        }
        for hurst in settings["lines"]["hurst"]
    }
    for hurst, points in itertools.product(settings["sizes"]["hurst"], settings["sizes"]["points"]):
        cases[f"{hurst_id(hurst)}_n{points}"] = {
            "group": "sizes",
            "spawn_key": list(seeds.size_line_key(hurst, points)),
            "surface": shared | {"hurst": hurst},
            "points": points,
            **{name: settings["sizes"][name] for name in ("realizations", "batch")},
        }
    return cases


def method_problems(settings):
    """{problem: arguments of methods.named_problem} of every indenter on which methods are compared."""
    methods = settings["methods"]
    bodies = {
        f"{body}_{n}": {"name": body, "elements": n} for body in ("sphere", "cone") for n in methods["bodies_elements"]
    }
    return bodies | {
        f"rough_{hurst_id(hurst)}_{n}": {"name": "rough disc", "hurst": hurst, "elements": n}
        for hurst in methods["hurst"]
        for n in methods["elements"]
    }


def batches(case):
    """Names of a case's batches, first and last realization: 0000-0007, 0008-0015, ..."""
    number, size = case["realizations"], case["batch"]
    return [f"{first:04d}-{min(first + size, number) - 1:04d}" for first in range(0, number, size)]


def groups():
    """The groups of disc ensembles of one size: base, which the nine combinations are, and the variants."""
    return list(dict.fromkeys(case["group"] for case in DISCS.values() if case["group"] not in ("sizes", "controls")))


# ---- params and inputs of rules


def peers():
    """{peer: Python of its environment, adapter}, whether or not `make peers` has built the environments."""
    adapters, root = WORKFLOW / "peers", Path(workflow.basedir)
    modern, slippy = (str(root / name / "bin" / "python") for name in (".venv-peers", ".venv-slippy"))
    pythons = {"ASPHER": modern, "ContactMechanics": modern, "SlipPY": slippy, "Tamaas": modern}
    return {name: [python, str(adapters / f"{name.lower()}_adapter.py")] for name, python in pythons.items()}


def of_disc(name):
    """Params function: a value of the disc's case."""
    return lambda wildcards: DISCS[wildcards.case][name]


def of_line(name):
    """Params function: a value of the line's case."""
    return lambda wildcards: LINES[wildcards.line][name]


def realizations(wildcards):
    """First realization of a batch, and the one after its last."""
    first, last = wildcards.batch.split("-")
    return [int(first), int(last) + 1]


def curves_of_disc(wildcards):
    return expand("results/curves/discs/{case}/{batch}.nc", case=wildcards.case, batch=batches(DISCS[wildcards.case]))


def curves_of_line(wildcards):
    return expand("results/curves/lines/{line}/{batch}.nc", line=wildcards.line, batch=batches(LINES[wildcards.line]))


def ensembles(group, kind="discs"):
    """Ensembles of all cases of a group of discs or, with kind "lines", of lines."""
    cases = {"discs": DISCS, "lines": LINES}[kind]
    return [f"results/ensembles/{kind}/{name}.nc" for name, case in cases.items() if case["group"] == group]


def lines_of_discs():
    """Ensembles of the lines that have the Hurst exponent of discs."""
    return expand("results/ensembles/lines/{line}.nc", line=[hurst_id(hurst) for hurst in config["discs"]["hurst"]])


def paper(name):
    """What a file in resources/paper says."""
    return yaml.safe_load((WORKFLOW.parent / "resources" / "paper" / f"{name}.yaml").read_text(encoding="utf-8"))


def example_discs():
    """Params: realization 0 of the first combination for every Hurst exponent, with h = L = 1."""
    first = config["discs"]["combinations"][0]["number"]
    cases = [DISCS[f"{hurst_id(hurst)}_c{first}"] for hurst in config["discs"]["hurst"]]
    return {
        "spawn_keys": [case["spawn_key"] for case in cases],
        "discs": [case["surface"] | {"rms": 1.0, "diameter": 1.0} for case in cases],
    }


def combinations():
    """{case: force [N], viscosity [Pa s], diameter [m], rms [m]} of the base cases."""
    return {name: case["combination"] for name, case in DISCS.items() if case["group"] == "base"}


# MB of a job before its arrays: Python with what it imports and, as a job of Slurm, two Snakemakes around it.
BASE_MEMORY = 700


def disc_memory(wildcards):
    """MB for a batch of heights, the square that they are cut from and the fields on a doubled grid."""
    examples = config["discs"] | {"batch": len(config["discs"]["hurst"]), "surface": config["surface"]}
    case = DISCS.get(wildcards.get("case"), examples)
    heights, square = 24 * case["batch"], 64 * case["surface"]["period"] ** 2
    return round(BASE_MEMORY + (heights + square + 400) * case["elements"] ** 2 / 1e6)


def large_memory(wildcards):
    """MB for one disc by boundary elements."""
    return round(BASE_MEMORY + 500 * int(wildcards.elements) ** 2 / 1e6)


def line_memory(wildcards):
    """MB for the spectrum of a line, its heights and gaps."""
    return round(BASE_MEMORY + 40 * LINES[wildcards.line]["points"] / 1e6)


# ---- digests of the package's modules, so that an edit reruns exactly what uses it


@cache
def imported(path):
    """Files of the two packages that a Python file imports, with the __init__ of the packages around them."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    found = set()
    for name in names:
        if name.split(".")[0] not in ("viscorough", "viscorough_study"):
            continue
        place = PACKAGES
        for part in name.split("."):
            place = place / part
            found |= {each for each in (place / "__init__.py", place.with_suffix(".py")) if each.is_file()}
    return found


@cache
def source_digest(rule):
    """Digest of a rule's script and of the modules that it uses, directly or through each other.

    Snakemake sees edits of scripts, but not of what they import, nor of a script whose output was temporary.
    """
    script = WORKFLOW / "scripts" / f"{rule}.py"
    used, new = {script}, imported(script)
    while new:
        used |= new
        new = set().union(*map(imported, new)) - used
    digest = hashlib.sha256()
    for path in sorted(used):
        digest.update(os.path.relpath(path, PACKAGES if path.is_relative_to(PACKAGES) else WORKFLOW).encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


# ---- numba


def compile_kernels():
    """Fill numba's cache once before any job, for many processes that compile into it at once can crash.

    No rule: an output that many jobs need would rerun them all when it is made again, and as an `ancient` input it
    hides from Snakemake that their own params changed.
    """
    stamp = Path(".snakemake") / "kernels"
    digest = f"{source_digest('indent_discs')} {source_digest('indent_lines')}"
    if stamp.is_file() and stamp.read_text() == digest:
        return
    code = (
        "from viscorough import mdr, surfaces; from viscorough.contact import loading_path;"
        "loading_path.indent(surfaces.self_affine_disc(0.6, 65, seed=0));"
        "[mdr.reduce(surfaces.self_affine_line(0.6, 256, seed=0, dtype=dtype)) for dtype in ('f4', 'f8')]"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
    stamp.write_text(digest)
