"""Collect the results for the lower part of the page: verdicts on the paper's claims, tables, and size of the run."""

import json

import numpy as np
import pandas as pd
import yaml

from viscorough.io.netcdf import opened
from viscorough_study.run.cases import medium_label
from viscorough_study.verdicts.claims import (
    KINDS,
    case_counts,
    cases_shown,
    deciding_case,
    is_trial,
    overall,
    place,
    value_text,
    verdict_text,
)

VERDICT_SHORT = {
    "reproduced": "yes",
    "reproduced under a stated convention": "partly",
    "reproduced in part": "partly",
    "not reproduced": "no",
    "undecided": "open",
}


def verdicts(results, statements, published):
    """Return the paper's claims with their verdicts, grouped by kind: {heading of the kind: list of claims}.

    A claim is tested in several cases, such as Hurst exponents. Each claim is a dict with its statement, its verdict,
    and the numbers of the cases that the page shows. If the published verdict differs from the verdict of this run,
    `full_scale` is the published verdict with the case that decides it; otherwise it is None.

    statements : content of resources/paper/claims.yaml
    published : published table of claims, from a run with the grids and numbers of surfaces of the paper
    """
    claims, at_full_scale = {heading: [] for heading in KINDS.values()}, overall(published)
    for name, verdict in overall(results.tables["claims"]).items():
        rows, full_scale = results.rows("claims", claim=name), None
        displayed = cases_shown(rows)
        if at_full_scale.get(name, verdict) != verdict:
            claim_cases = published[published["claim"] == name]
            deciding = claim_cases.loc[deciding_case(claim_cases)]
            full_scale = {"verdict": at_full_scale[name], "case": f"{deciding['case']}: {value_text(deciding)}"}
        claims[KINDS[statements[name]["kind"]]].append(
            {
                **statements[name],
                "name": name,
                "where": place(statements[name]),
                "tolerance": results.number("claims", rows.index[0], "tolerance"),
                "verdict": verdict,
                "verdict_text": verdict_text(rows),
                "case_counts": case_counts(rows),
                "full_scale": full_scale,
                "deciding": results.record("claims", deciding_case(rows)),
                "cases": [results.record("claims", i) for i in displayed.index],
                "left_out": len(rows) - len(displayed),
            }
        )
    return {heading: members for heading, members in claims.items() if members}


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


def media(results):
    """Return the local exponent d ln(vt/h)/d ln t, for each medium and Hurst exponent, at three times.

    The keys "first" and "last" are the first and the last time of the table `media`. The key "middle" is the time t
    when the reduced time X is nearest to 0.01.
    """
    table, rows = results.tables["media"], []
    for (name, hurst), part in table.groupby(["medium", "hurst"], sort=False):
        middle = np.log(part["x"] / 0.01).abs().idxmin()
        places = {"first": part.index[0], "middle": middle, "last": part.index[-1]}
        exponents = {when: results.number("media", row, "exponent") for when, row in places.items()}
        rows.append({"medium": medium_label(name), "hurst": hurst} | exponents)
    return rows


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
        "realizations": min(indentation.get("whole_curves", np.inf), run["realizations"]),
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

    A case in the file is a set of random surfaces with the same settings. Cases form groups.

    realizations : number of surfaces of the first case
    description : settings of the first case
    hurst : Hurst exponents of all cases in the group of the first case
    cases_per_hurst : number of cases in the same group that have the Hurst exponent of the first case
    groups : names of all groups
    """
    with opened(path) as file:
        settings = json.loads(file.getncattr("settings"))
        case, hurst, group = (np.ma.getdata(file[name][...]) for name in ("case", "hurst", "group"))
    base = group == group[0]
    first = case[0]
    description = settings[str(first)]
    return {
        "realizations": int((case == first).sum()),
        "hurst": sorted({float(value) for value in hurst[base]}),
        "cases_per_hurst": len(set(case[base & (hurst == hurst[0])])),
        "groups": list(dict.fromkeys(group.tolist())),
        "description": description | description["ensembles"][0],
    }
