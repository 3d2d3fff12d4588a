"""Content of the page about the scale, the methods and other solvers."""

import json
from itertools import combinations

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml

from support.study import NUMBERS, ROOT
from viscorough_study.page.content import claims, failures, findings, in_short, measured, scale, verdict_counts
from viscorough_study.page.results import Results


def pool(path, description, realizations):
    """Make a pool of two cases for each of two Hurst exponents."""
    cases = np.repeat(["h04_c1", "h04_c2", "h09_c1", "h09_c2"], realizations)
    variables = {
        "case": ("realization", cases.astype(object)),
        "hurst": ("realization", np.repeat([0.4, 0.4, 0.9, 0.9], realizations)),
        "group": ("realization", np.full(cases.size, "base", dtype=object)),
    }
    indentation = {"whole_curves": 9, "short_until_x": 1.8}
    settings = json.dumps({"h04_c1": {"seed": 1, "indentation": indentation, "ensembles": [description]}})
    xr.Dataset(variables, attrs={"settings": settings}).to_netcdf(path)
    return path


@pytest.mark.parametrize(
    ("elements", "realizations", "lines", "points", "name"),
    [
        (257, 80, 500, 131_072, "paper"),
        (257, 80, 50, 4_000_000, "trial"),
        (33, 80, 500, 4_000_000, "coarse"),
    ],
)
def test_scale_follows_from_the_ensembles(tmp_path, elements, realizations, lines, points, name):
    discs = pool(tmp_path / "discs.nc", {"elements": elements}, realizations)
    lines_pool = pool(tmp_path / "lines.nc", {"points": points}, lines)
    content = scale(discs, lines_pool, NUMBERS)
    assert content["name"] == name
    assert content["run"] == {"elements": elements, "realizations": realizations, "points": points, "lines": lines}
    assert content["whole"] == {"realizations": 9, "from_x": 1.8}
    assert (content["discs"]["hurst"], content["discs"]["cases_per_hurst"]) == ([0.4, 0.9], 2)


def test_numbers_stand_in_the_rows_for_which_they_are_shown():
    conventions = {"rms_convention": "disc", "average": "geometric", "window_rule": "default"}
    fits = pd.DataFrame({"case_group": ["j", "k", "k"], **conventions, "beta": [0.1, 0.2, 0.3]})
    fits.loc[2, "average"] = "arithmetic"
    tables = {"measured_fits": fits, "measured_scans": pd.DataFrame({"file": ["g"]})}
    tables |= {"measured_contacts": pd.DataFrame({"file": ["g", "g"], "normal_force": [0.1, 0.2]})}
    results = Results(tables, {})
    rows_of_scans = measured(results, conventions)
    assert rows_of_scans["scans"] == [{"file": "g"}]
    assert [(row["file"], row["normal_force"].value) for row in rows_of_scans["contacts"]] == [("g", 0.1), ("g", 0.2)]
    assert [(row["case_group"], row["beta"].value) for row in rows_of_scans["groups"]] == [("j", 0.1), ("k", 0.2)]
    assert measured(Results({}, {}), conventions) == {"scans": [], "contacts": [], "groups": []}


IN_SHORT = yaml.safe_load((ROOT / "workflow/page/in_short.yaml").read_text(encoding="utf-8"))
CLAIMS = pd.read_csv(ROOT / "docs/claims.csv").fillna({"reading": "", "note": ""})
PUBLISHED = Results({"claims": CLAIMS}, {})


def test_every_case_is_shown_once_in_each_reading():
    shown = claims(PUBLISHED)
    rows = [row["value"].row for claim in shown for case in claim["cases"] for row in case["readings"].values()]
    assert sorted(rows) == CLAIMS.index.tolist()
    for claim in shown:
        for case in claim["cases"]:
            for reading, row in case["readings"].items():
                assert (row["claim"], row["case"], row["reading"]) == (claim["claim"].name, case["name"], reading)
                assert case["expected"].value == pytest.approx(row["expected"].value, nan_ok=True)


def test_findings_hold_every_claim_but_identities():
    shown = claims(PUBLISHED)
    grouped = [claim["claim"].name for figure, members in findings(shown) for claim in members]
    assert sorted(grouped) == sorted(c["claim"].name for c in shown if c["claim"].kind != "identity")
    assert all(claim["claim"].figure == figure for figure, members in findings(shown) for claim in members)
    assert [sum(number.value for number in counts) for counts in verdict_counts(PUBLISHED).values()] == [15, 5]


def test_lines_in_short_group_own_claims_by_their_verdicts():
    groups = in_short(claims(PUBLISHED), IN_SHORT)
    named = [(claim["claim"], text) for _, members in groups for claim, text in members]
    assert {claim.name: text for claim, text in named} == IN_SHORT
    assert {claim.kind for claim, _ in named} == {"own"}
    words = [{claim["verdict"].word for claim, _ in members} for _, members in groups]
    assert all(a.isdisjoint(b) for a, b in combinations(words, 2))


def test_worst_error_of_the_models_is_a_stated_error():
    rows = [("MDR", "stated", 0.3), ("MDR", "holds", 0.4), ("power law", "warned", 0.2), ("path", "warned", 0.5)]
    table = pd.DataFrame(rows, columns=["method", "verdict", "error"]).assign(group="a", case="b", reason="c")
    content = failures(Results({"failures": table}, {}))
    assert content["worst_model"].value == 0.3
    assert (content["cases"].value, content["warned"].value, content["unnoticed"].value) == (2, 2, 0)
    assert content["methods"]["MDR"] == {"stated": 1, "holds": 1}
