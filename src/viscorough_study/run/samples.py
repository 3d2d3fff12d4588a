"""List the samples that the settings define, divide them into batches, and estimate the memory of their jobs.

A sample is a dictionary for the jobs that compute loading curves. It describes one or several ensembles of surfaces.
Samples of the same kind form a group. A pool contains the curves of all samples that are evaluated together, at common
abscissae. The indenters in the comparison of methods are listed here as well.

A job computes one batch, that is, some realizations of a sample. There are two ways to form the batches of a sample
with several ensembles:

- Side by side: a batch has the same realizations of all ensembles of the sample. Combinations of force, viscosity,
  diameter and rms height at one Hurst exponent are batched in this way. Combinations 1 to 9 are one sample and 10 to 19
  the next sample, so a tenth combination does not change the curves of the first nine. Lines of neighbouring Hurst
  exponents are batched in this way, too, since most jobs would take less time than their start.
- In sequence: a batch has realizations of one ensemble and then of the next. Discs on coarse grids are batched in this
  way, so that a job can hold many small discs.

Names of samples are parts of file names, which contain no floating-point numbers. Names of ensembles are in the tables
of results.
"""

import itertools
import math

from viscorough_study.run import seeds

# {pool of curves: conventions for the rms height h of its surfaces}. A convention names the region where h is measured.
POOLS = {
    "discs": ("disc", "square", "ensemble"),
    "variants": ("disc", "square", "ensemble"),
    "coarse": ("disc",),
    "law": ("disc",),
    "lines": ("line",),
    "measured": ("disc",),
}
# {pool of curves: kind of its surfaces}. The kind is also the name of the folder with the curves.
POOL_KINDS = {
    "discs": "discs",
    "variants": "discs",
    "coarse": "discs",
    "law": "discs",
    "lines": "lines",
    "measured": "measured",
}
UNIT_DISC = {"rms": 1.0, "diameter": 1.0, "length_unit": "1"}
UNIT_LINE = {"rms": 1.0, "length": 1.0}


def hurst_id(hurst):
    """Return the text for a Hurst exponent in file names, such as h01000 for 0.1."""
    return f"h{round(hurst * 1e4):05d}"


def disc_samples(settings):
    """Return {name: description} of all samples of discs.

    A sample describes ensembles of discs for the jobs that compute their loading curves. Its description has the keys
    pool, group, realizations, batch, indentation and ensembles. Each ensemble has the keys name, spawn_key, elements,
    surface (arguments of self_affine_disc) and realizations. In the group "base" an ensemble also has the key
    combination.

    The seed of a disc is the spawn key followed by the number of the realization (run.seeds). `realizations` of a
    sample is the sum over its ensembles, or, if `side_by_side` is true, the number for each ensemble.
    """
    return _combined_discs(settings) | _single_discs(settings)


def _combined_discs(settings):
    """Return the samples of the group "base": all combinations of force, viscosity, diameter and rms height."""
    samples, discs, curves = {}, settings["discs"], settings["curves"]
    ends = {name: curves[name] for name in ("tolerance", "until_x", "whole", "short_until_x")}
    base = {"pool": "discs", "group": "base", "indentation": ends, "side_by_side": True}
    base |= {"realizations": discs["realizations"], "batch": discs["batch"]}
    for hurst in settings["hurst"]:
        for combination in discs["combinations"]:
            number, lengths = combination["number"], {name: combination[name] for name in ("rms", "diameter")}
            surface = settings["surface"] | {"hurst": hurst, "length_unit": "m"} | lengths
            ensemble = _ensemble(f"{hurst_id(hurst)}_c{number}", seeds.disc_key(hurst, number), surface, discs)
            name = hurst_id(hurst) + (f"_{number // 10}0" if number >= 10 else "")
            sample = samples.setdefault(name, base | {"ensembles": []})
            sample["ensembles"].append(ensemble | {"combination": combination})
    return samples


def _single_discs(settings):
    """Return the samples of all other discs, which have a single combination, h = L = 1 m."""
    samples, discs, curves = {}, settings["discs"], settings["curves"]

    def add(name, pool, group, until_x, ensembles):
        ends = {"tolerance": curves["tolerance"], "until_x": until_x}
        samples[name] = _in_sequence(ensembles, discs["single_batch"], group, pool=pool, indentation=ends)

    longer, roll_off = discs["longer_period"], discs["roll_off"]
    changed = {
        "longer_period": ("discs", longer["realizations"], {"period": longer["period"], "rms_over": "square"}),
        "roll_off": ("discs", roll_off["realizations"], {"roll_off_wavelength": roll_off["wavelength"]}),
    }
    for variant in discs["variants"]["surfaces"]:
        properties = {key: value for key, value in variant.items() if key != "name"}
        changed[variant["name"]] = ("variants", discs["variants"]["realizations"], properties)
    surface = settings["surface"] | UNIT_DISC
    for hurst in settings["hurst"]:
        for group, (pool, realizations, properties) in changed.items():
            name, grid = f"{hurst_id(hurst)}_{group}", {"elements": discs["elements"], "realizations": realizations}
            key = seeds.variant_key(hurst, group)
            ensemble = _ensemble(name, key, surface | properties | {"hurst": hurst}, grid)
            add(name, pool, group, curves["region_until_x"], [ensemble])
    grids = {"coarse": (settings["hurst"], discs["coarse"]["elements"], curves["short_until_x"])}
    grids["law"] = discs["law"]["hurst"], [discs["elements"]], curves["until_x"]
    for group, (exponents, elements, until_x) in grids.items():
        realizations = discs[group]["realizations"]
        ensembles = [
            _ensemble(
                group,
                seeds.grid_disc_key(hurst, across),
                surface | {"hurst": hurst},
                {"elements": across, "realizations": realizations},
            )
            for hurst, across in itertools.product(exponents, elements)
        ]
        add(group, group, group, until_x, ensembles)
    return samples


def _ensemble(name, spawn_key, surface, grid):
    """Return the description of an ensemble of surfaces, as it is stored in a sample (see `disc_samples`).

    grid : settings that contain the number of realizations, and the number of elements across a disc or of points of a
        line
    """
    numbers = {key: grid[key] for key in ("elements", "points", "realizations") if key in grid}
    return {"name": name, "spawn_key": spawn_key, "surface": surface} | numbers


def _in_sequence(ensembles, batch, group, **shared):
    """Return the description of a sample (see `disc_samples`) whose batches run through its ensembles in sequence.

    batch : number of realizations in a batch; shared : further keys of the description
    """
    realizations = sum(ensemble["realizations"] for ensemble in ensembles)
    return shared | {"group": group, "ensembles": ensembles, "realizations": realizations, "batch": batch}


def line_samples(settings):
    """Return {name: description} of all samples of lines.

    A sample describes ensembles of lines for the jobs that compute their loading curves. Descriptions are dicts with
    the same keys as in `disc_samples`, with these exceptions:

    - The key `until_x` replaces the key `indentation`.
    - In an ensemble, the key `points` replaces the key `elements`, and there is no key `combination`.
    - In an ensemble, the value of the key `surface` contains arguments of self_affine_line.

    Hurst exponents with the same first decimal, such as 0.40 and 0.45, share a sample, whose batches are side by side.
    """
    lines, samples = settings["lines"], {}
    base = {"pool": "lines", "group": "lines", "until_x": settings["curves"]["until_x"], "side_by_side": True}
    base |= {"realizations": lines["realizations"], "batch": lines["batch"]}
    names = ("amplitudes", "roll_off_wavelength", "roll_off_level")
    surface = {name: settings["surface"][name] for name in names} | UNIT_LINE
    for hurst in _line_exponents(settings):
        line = _ensemble(hurst_id(hurst), seeds.line_key(hurst), surface | {"hurst": hurst}, lines)
        sample = samples.setdefault(hurst_id(math.floor(10 * hurst + 1e-9) / 10), base | {"ensembles": []})
        sample["ensembles"].append(line)
    return samples


def _line_exponents(settings):
    """Return the Hurst exponents of lines: those of discs, and the multiples of `lines.hurst_step` from 0 to 1."""
    step = settings["lines"]["hurst_step"]
    further = [] if step is None else [round(i * step, 4) for i in range(int(1 / step + 1e-9) + 1)]
    return sorted({*settings["hurst"], *further})


def nested_samples(settings):
    """Return {name: description} of the discs whose curves are computed on several grids.

    A sample belongs to one Hurst exponent and one grid. Its description has the keys realizations and batch, as in
    `disc_samples`, and the keys hurst, spawn_key, elements (across discs, on the grid and on all coarser grids) and
    until_x, which are arguments of ensembles.nested_grids.nested_curves.
    """
    samples = {}
    for ensemble in settings["fine_grids"]["ensembles"]:
        coarser = []
        for grid in ensemble["grids"]:
            coarser = [grid["elements"], *coarser]
            samples[f"{hurst_id(ensemble['hurst'])}_{grid['elements']:05d}"] = {
                "hurst": ensemble["hurst"],
                "elements": coarser,
                "spawn_key": seeds.nested_disc_key(ensemble["hurst"], grid["elements"]),
                "until_x": grid["until_x"],
                "realizations": grid["surfaces"],
                "batch": grid["batch"],
            }
    return samples


def nested_arguments(sample, batch):
    """Return the arguments of ensembles.nested_grids.nested_curves for one job, which is a batch of discs."""
    first, last = map(int, batch.split("-"))
    names = ("hurst", "elements", "spawn_key", "until_x")
    return {name: sample[name] for name in names} | {"numbers": [first, last + 1]}


def nested_files(samples):
    """Return the names of the files with the curves of discs on several grids; samples : result of `nested_samples`."""
    return [f"results/curves/nested/{name}/{batch}.nc" for name, sample in samples.items() for batch in batches(sample)]


def method_problems(settings):
    """Return the arguments of performance.problems.named_problem for every indenter in the comparison of methods."""
    methods = settings["methods"]
    bodies = [{"name": body, "elements": n} for body in methods["bodies"] for n in methods["bodies_elements"]]
    return bodies + [{"name": "rough disc", "hurst": 0.8, "elements": n} for n in methods["elements"]]


def first_combination(settings):
    """Return the names of the ensembles with the first parameters in discs.combinations, one for every Hurst exponent.

    The parameters are force, viscosity, diameter and rms height.
    """
    first = settings["discs"]["combinations"][0]["number"]
    return [f"{hurst_id(hurst)}_c{first}" for hurst in settings["hurst"]]


def combined_ensembles(settings):
    """Return {name: description} of the base ensembles, one ensemble for every combination and Hurst exponent.

    A combination consists of force, viscosity, diameter and rms height.
    """
    bases = (sample for sample in disc_samples(settings).values() if sample["group"] == "base")
    return {ensemble["name"]: ensemble for sample in bases for ensemble in sample["ensembles"]}


def combinations(settings):
    """Return {name of a base ensemble: its force [N], viscosity [Pa s], diameter [m], rms height [m]}."""
    return {name: ensemble["combination"] for name, ensemble in combined_ensembles(settings).items()}


def example_discs(settings):
    """Return ensembles that contain only the first disc of each Hurst exponent, scaled to h = L = 1.

    This disc is realization 0 of the first combination. The ensembles have the form of `batch_ensembles`.
    """
    ensembles = combined_ensembles(settings)
    examples = [_in_batch(ensembles[name], [0, 1]) for name in first_combination(settings)]
    return [example | {"surface": example["surface"] | UNIT_DISC} for example in examples]


# ---- batches; a batch contains the realizations that one job computes


def batches(sample):
    """Return the names of the batches (jobs) of a sample, such as 0008-0015 for realizations 8 to 15."""
    number, size = sample["realizations"], sample["batch"]
    return [f"{first:04d}-{min(first + size, number) - 1:04d}" for first in range(0, number, size)]


def batch_ensembles(sample, batch):
    """Return the parts of the ensembles of a sample that one job computes, which is a batch of realizations.

    A part is a dict with the keys name, spawn_key, surface, elements or points, and numbers. `numbers` is the range of
    realizations in this batch, [first, end]; end is not included.
    """
    first, last = map(int, batch.split("-"))
    parts, before = [], 0
    for ensemble in sample["ensembles"]:
        after = before + ensemble["realizations"]
        if before <= last and first < after:
            parts.append(_in_batch(ensemble, [max(first - before, 0), min(last + 1, after) - before]))
        before = 0 if sample.get("side_by_side") else after
    return parts


def _in_batch(ensemble, numbers):
    kept = ("name", "spawn_key", "surface", "elements", "points")
    return {name: ensemble[name] for name in kept if name in ensemble} | {"numbers": numbers}


def pool_batches(samples, pool):
    """Return [(name of the sample, name of the batch)] for all batches from which a pool of curves is made.

    They are in the order of the descriptions.

    samples : {kind of surface: {name of a sample: description}}
    """
    own = samples[POOL_KINDS[pool]]
    return [(name, batch) for name, sample in own.items() if sample["pool"] == pool for batch in batches(sample)]


def pool_curves(samples, pool):
    """Return the names of the files with the loading curves of a pool.

    samples : {kind of surface: {name of a sample: description}}
    """
    return [f"results/curves/{POOL_KINDS[pool]}/{sample}/{batch}.nc" for sample, batch in pool_batches(samples, pool)]


def pool_groups(samples, pool):
    """Return a list with the group, such as "base", of the surfaces in each batch of a pool of curves.

    samples : {kind of surface: {name of a sample: description}}
    """
    return [samples[POOL_KINDS[pool]][sample]["group"] for sample, _ in pool_batches(samples, pool)]


def combination_curves(discs):
    """Return the names of the files with the loading curves of the base discs, which all figures use.

    These are the curves of all combinations of force, viscosity, diameter and rms height.
    discs : {name of a sample: description}
    """
    bases = {name: sample for name, sample in discs.items() if sample["group"] == "base"}
    return [f"results/curves/discs/{name}/{batch}.nc" for name, sample in bases.items() for batch in batches(sample)]


# ---- memory of jobs [MB]

# Memory of Python and imported modules. In a Slurm job it includes the two Snakemake processes that run the job.
BASE_MEMORY = 700


def generation_memory(ensembles):
    """Return the memory [MB] of a job that generates discs: for one disc and the square from which it is cut."""
    bytes_ = max((24 + 64 * ensemble["surface"]["period"] ** 2) * ensemble["elements"] ** 2 for ensemble in ensembles)
    return round(BASE_MEMORY + bytes_ / 1e6)


def grid_memory(elements, surfaces=0):
    """Return the memory [MB] of a job that solves contacts on a grid.

    It includes the fields of the solver on a grid twice as wide as the surface.
    elements : elements across the surface; surfaces : number of further surfaces whose heights the job keeps
    """
    return round(BASE_MEMORY + (424 + 8 * surfaces) * elements**2 / 1e6)


def disc_memory(sample):
    """Return the memory [MB] of a job that indents discs."""
    return grid_memory(max(ensemble["elements"] for ensemble in sample["ensembles"]))


def nested_memory(sample):
    """Return the memory [MB] of a job that indents discs on several grids: surfaces and fields of the finest grid.

    The curves end at small contacts, so the solver needs less than for whole curves.
    """
    return round(BASE_MEMORY + 150 * sample["elements"][0] ** 2 / 1e6)


def measured_memory(sample):
    """Return the memory [MB] of a job that indents a measured surface, including the fields of the solver.

    The memory follows from the size of the file with the heights, which has at least four bytes per height.
    """
    return round(BASE_MEMORY + 400 / 4 * sample["bytes"] / 1e6)


def line_memory(sample):
    """Return the memory [MB] of a job that applies dimensionality reduction to lines.

    The memory is for the spectrum, heights and gaps of a line.
    """
    return round(BASE_MEMORY + 40 * max(ensemble["points"] for ensemble in sample["ensembles"]) / 1e6)


def pool_memory(samples, pool, curves):
    """Return the memory [MB] of a job that pools curves: for two copies of all realizations on common abscissae.

    samples : {kind of surface: {name of a sample: description}}
    curves : section `curves` of the settings
    """
    own = [sample for sample in samples[POOL_KINDS[pool]].values() if sample["pool"] == pool]
    members = [member for sample in own for member in sample.get("ensembles", [sample])]
    realizations = sum(member["realizations"] for member in members)
    abscissae = 1 + curves["per_decade"] * math.log10(curves["until_x"] / curves["x_low"])
    variables = 2 * len(POOLS[pool])
    return round(BASE_MEMORY + 2 * 8 * variables * realizations * abscissae / 1e6)
