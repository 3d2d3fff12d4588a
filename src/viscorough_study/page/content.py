"""Collect the contents of the page: claims with their verdicts, tables, stress tests, and the size of the run."""

import json
from collections import Counter

import numpy as np
import pandas as pd
import yaml

from viscorough.io.netcdf import opened
from viscorough_study.page.results import Number
from viscorough_study.robustness.stress_solutions import MODELS
from viscorough_study.verdicts.claim import KINDS
from viscorough_study.verdicts.claims import CLAIMS, counted_verdicts, is_trial, verdicts_of

MARKS = {"holds": "yes", "holds in A": "partly", "holds in B": "partly", "in part": "partly", "not": "no"}
COUNTED = ("own", "quoted")  # kinds of claims that are counted


def claims(results):
    """Return the claims of the run as dicts, in the order of the page.

    claim : Claim; verdict : Verdict; mark : class of the verdict in the style sheet
    tolerance : Number
    cases : a dict for each case, with its name, the value expected by the paper (a Number), and for each reading the
        row of the table of verdicts (Results.record)
    expected : True if the paper states a value for any case
    """
    verdicts, shown = verdicts_of(results.tables["claims"]), []
    for claim in (claim for claim in CLAIMS if claim.name in verdicts):
        rows, verdict = results.rows("claims", claim=claim.name), verdicts[claim.name]
        cases = []
        for name, of_case in rows.groupby("case", sort=False):
            records = {row["reading"]: results.record("claims", i) for i, row in of_case.iterrows()}
            cases.append({"name": name, "expected": next(iter(records.values()))["expected"], "readings": records})
        tolerance = results.number("claims", rows.index[0], "tolerance")
        described = {"claim": claim, "verdict": verdict, "mark": mark(verdict.word), "tolerance": tolerance}
        shown.append(described | {"cases": cases, "expected": rows["expected"].notna().any()})
    return shown


def mark(word):
    """Return the class of a verdict in the style sheet."""
    return MARKS.get(word, "open")


def findings(shown):
    """Group claims by the figure that shows them: [(name of the figure, claims)], in the order of the claims.

    shown : result of `claims`; identities belong to no finding
    """
    groups = {}
    for claim in shown:
        if claim["claim"].kind != "identity":
            groups.setdefault(claim["claim"].figure, []).append(claim)
    return list(groups.items())


def in_short(shown, texts):
    """Group the paper's own claims by how they fare: [(heading, [(claim, text)])], without empty groups.

    shown : result of `claims`
    texts : {name of a claim: what it says, in a few words}; claims without a text are left out
    """
    headings = {
        "Holds": ("holds",),
        "Holds in part, or for bodies made in one of two ways (A, B), none of which gives all": (
            "holds in A",
            "holds in B",
            "in part",
        ),
        "Undecided": ("undecided",),
        "Does not hold": ("not",),
    }
    named = [(claim, texts[claim["claim"].name]) for claim in shown if claim["claim"].name in texts]
    groups = {heading: [c for c in named if c[0]["verdict"].word in words] for heading, words in headings.items()}
    return [(heading, members) for heading, members in groups.items() if members]


def verdict_counts(results):
    """Return {heading of a kind: list of `Number`}, how many of its claims have which verdict, for counted kinds."""
    counts = {}
    for kind in COUNTED:
        column, place = f"verdict over all cases of the claims of kind {kind}", results.origin("claims")
        numbers = counted_verdicts(results.tables["claims"], kind)
        counts[KINDS[kind]] = [Number(number, "claims", column, counted=word, origin=place) for word, number in numbers]
    return counts


def failures(results):
    """Return the numbers that the page states about the stress tests of all methods (robustness.failure_map).

    tests : number of stress tests
    unnoticed : number of results that are wrong without a warning
    warned : number of results that are wrong, but come with a warning
    stated : number of results of models that are wrong outside their documented range, without a warning
    worst_model : largest finite error of an approximate model that warned or was used outside its documented range
    methods : {method: {verdict: number of stress tests}}
    """
    table = results.tables["failures"]
    outside = table[table["method"].isin(MODELS) & table["verdict"].isin(["stated", "warned"])]
    return {
        # each method has one row per stress test
        "tests": results.count("failures", "method", table["method"].iloc[0]),
        **{name: results.count("failures", "verdict", name) for name in ("unnoticed", "warned", "stated")},
        "worst_model": results.extremes(outside[np.isfinite(outside["error"])], "failures", "error")[1],
        "methods": {name: Counter(rows["verdict"]) for name, rows in table.groupby("method", sort=False)},
    }


def mdr_time(results):
    """Return the processor times of one disc and of one line (MDR), which the paper compares as weeks and minutes.

    disc, across : time of a loading curve on the finest grid at a tolerance of 1e-3, and its elements across
    line, points : time of the line with the most points, and its number of points
    """
    table = results.tables["methods"]
    discs = table[(table["method"] == "path, automatic levels") & (table["value"] == 1e-3)]
    disc, line = discs["elements"].idxmax(), table.loc[table["method"] == "MDR", "value"].idxmax()
    named = {"disc": (disc, "processor_s"), "across": (disc, "elements")}
    named |= {"line": (line, "processor_s"), "points": (line, "value")}
    return {name: results.number("methods", *place) for name, place in named.items()}


def other_solvers(path):
    """Return published computing times of other solvers, divided by the time of viscorough.indent for the same levels.

    rows : a dict for each task (which levels on which grid), with the ratio of times for each solver
    versions : {solver: version}
    measured, machine : date and machine of the measurement
    path : CSV file of the published ratios
    """
    table = pd.read_csv(path)
    names = ["task", "hurst", "elements", "levels"]
    rows = [
        {**dict(zip(names, values, strict=True)), "ratios": dict(zip(group["solver"], group["ratio"], strict=True))}
        for values, group in table.groupby(names, sort=False)
    ]
    versions = dict(zip(table["solver"], table["version"], strict=True))
    return {"versions": versions, "rows": rows, **table[["measured", "machine"]].iloc[0]}


def second_solver(path):
    """Return the largest differences between the curves of this package and of another solver.

    force, beta, zeta : largest differences of the forces (relative), of β, and of ζ (relative)
    discs : number of discs for each Hurst exponent
    path : CSV file of the published comparison (benchmarks/second_solver.py)
    """
    table = pd.read_csv(path)
    differences = {name: table[f"{name}_difference"].abs().max() for name in ("force", "beta", "zeta")}
    return differences | table[["solver", "version", "discs"]].iloc[0].to_dict()


def measured(results, conventions):
    """Return the rows of three tables on measured surfaces: scans, contacts, and power laws of groups of scans.

    The lists are empty if the run has no measured scans.

    conventions : settings of the figures for choices that the paper leaves open: the kind of mean over surfaces, and
        the range of the fit. Only power laws for these settings are returned
    """
    if "measured_scans" not in results.tables:
        return {"scans": [], "contacts": [], "groups": []}
    chosen = {"rms_convention": "disc", "average": conventions["average"], "window_rule": conventions["window_rule"]}
    return {
        "scans": results.records("measured_scans"),
        "contacts": results.records("measured_contacts"),
        "groups": results.records("measured_fits", **chosen),
    }


# ---- scale


def scale(discs, lines, numbers):
    """Return the size of a run and of the paper: number of elements across a disc, and numbers of discs and lines.

    The name of the size is "coarse" if the discs have too few elements for a power law. It is "paper" if the run has at
    least as many discs, lines and elements across a disc as the paper. Otherwise it is "trial". The key "whole" has the
    number of discs of a combination whose curves extend beyond the X of the other curves, `from_x`.

    discs, lines : NetCDF files with the loading curves of all discs and of all lines of the run (ensembles.pool)
    numbers : content of resources/paper/numbers.yaml
    """
    pools = {"discs": _pool(discs), "lines": _pool(lines)}
    elements, reduction = numbers["boundary_elements"], numbers["reduction"]
    paper = {
        "elements": elements["elements_across"]["value"],
        "realizations": elements["realizations_min"]["value"],
        "points": reduction["points"]["value"],
        "lines": reduction["realizations"]["value"],
    }
    run = {
        "elements": pools["discs"]["description"]["elements"],
        "realizations": pools["discs"]["realizations"],
        "points": pools["lines"]["description"]["points"],
        "lines": pools["lines"]["realizations"],
    }
    indentation = pools["discs"]["description"].get("indentation", {})
    whole = {
        "realizations": min(indentation.get("whole", np.inf), run["realizations"]),
        "from_x": indentation.get("short_until_x"),
    }
    as_many = all(run[name] >= paper[name] for name in ("elements", "realizations", "lines"))
    coarse = is_trial(run["elements"], paper["elements"])
    return {
        "name": "coarse" if coarse else "paper" if as_many else "trial",
        "run": run,
        "paper": paper,
        "whole": whole,
        **pools,
    }


def as_yaml(value):
    """Return a setting as it is written in a settings file, on one line."""
    return yaml.safe_dump(value, default_flow_style=True, width=np.inf, sort_keys=False).removesuffix("...\n").strip()


def _pool(path):
    """Read how many random surfaces a NetCDF file of loading curves contains (ensembles.pool), and their settings.

    An ensemble in the file is a set of random surfaces with the same settings. Ensembles form groups.

    realizations : number of surfaces of the first ensemble
    description : settings of the first ensemble
    hurst : Hurst exponents of all ensembles in the group of the first ensemble
    ensembles_per_hurst : number of ensembles in the same group that have the Hurst exponent of the first ensemble
    groups : names of all groups
    """
    with opened(path) as file:
        settings = json.loads(file.getncattr("settings"))
        ensemble, hurst, group = (np.ma.getdata(file[name][...]) for name in ("ensemble", "hurst", "group"))
    base = group == group[0]
    return {
        "realizations": int((ensemble == ensemble[0]).sum()),
        "hurst": sorted({float(value) for value in hurst[base]}),
        "ensembles_per_hurst": len(set(ensemble[base & (hurst == hurst[0])])),
        "groups": list(dict.fromkeys(group.tolist())),
        "description": settings[0],
    }
