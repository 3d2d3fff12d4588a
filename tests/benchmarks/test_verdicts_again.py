"""Verdicts with other seeds, and with surfaces of a finished run drawn again, each among those of its own kind."""

import json

import numpy as np
import pandas as pd
import resampled_verdicts
import seeds
import xarray as xr
from click.testing import CliRunner


def test_curves_are_drawn_among_those_of_the_same_surfaces():
    """Cases of a Hurst exponent share their surfaces, groups and exponents do not; labels stay where they are."""
    group, hurst = np.repeat(["base", "base", "corners"], 40), np.repeat([0.4, 0.9, 0.9], 40)
    coordinates = {"group": group, "hurst": hurst, "case": np.tile(["c1", "c2"], 60)}
    coords = {name: ("realization", values) for name, values in coordinates.items()}
    pool = xr.Dataset({"stiffness": (("realization", "abscissa"), np.arange(120.0)[:, None])}, coords)
    drawn = resampled_verdicts.drawn(pool, np.random.default_rng(1))
    for name, values in coordinates.items():
        assert drawn[name].values.tolist() == values.tolist()
    came_from = drawn["stiffness"].values[:, 0].astype(int)
    assert (group[came_from] == group).all()
    assert (hurst[came_from] == hurst).all()
    assert (coordinates["case"][came_from] != coordinates["case"]).any()
    assert 60 < np.unique(came_from).size < 90, "about 63 % of them, with replacement"


def test_results_are_needed(tmp_path):
    output = tmp_path / "x.json"
    outcome = CliRunner().invoke(resampled_verdicts.main, [str(tmp_path), "--output", str(output)])
    assert (outcome.exit_code, output.exists()) == (1, False)
    assert outcome.output == f"Error: {tmp_path}: no tables/claims.csv there; make paper makes it\n"


def test_verdicts_that_change_with_the_seed_are_reported(tmp_path, monkeypatch):
    def claims(folder, settings, cores, option, seed):
        verdicts = ["reproduced", "reproduced" if seed == "seed=1" else "undecided"]
        return pd.DataFrame({"claim": ["steady", "unsteady"], "verdict": verdicts})

    monkeypatch.setattr(seeds, "claims", claims)
    output = tmp_path / "new/seeds.json"
    outcome = CliRunner().invoke(seeds.main, ["--seeds", "2", "--output", str(output)])
    assert outcome.exit_code == 1
    assert "1 of 2 verdicts change with the seed" in outcome.output
    assert json.loads(output.read_text())["moved"] == {"unsteady": ["reproduced", "undecided"]}
    assert pd.read_csv(output.with_suffix(".csv"))["seed"].tolist() == [1, 1, 2, 2]
