"""Surfaces of a finished run drawn again: each among those of its own kind."""

import numpy as np
import xarray as xr
from click.testing import CliRunner


def test_curves_are_drawn_among_those_of_the_same_surfaces(script):
    """Cases of a Hurst exponent share their surfaces, groups and exponents do not; labels stay where they are."""
    group, hurst = np.repeat(["base", "base", "corners"], 40), np.repeat([0.4, 0.9, 0.9], 40)
    about = {"group": group, "hurst": hurst, "case": np.tile(["c1", "c2"], 60)}
    coords = {name: ("realization", values) for name, values in about.items()}
    pool = xr.Dataset({"stiffness": (("realization", "abscissa"), np.arange(120.0)[:, None])}, coords)
    drawn = script("resampled_verdicts").drawn(pool, np.random.default_rng(1))
    for name, values in about.items():
        assert drawn[name].values.tolist() == values.tolist()
    came_from = drawn["stiffness"].values[:, 0].astype(int)
    assert (group[came_from] == group).all()
    assert (hurst[came_from] == hurst).all()
    assert (about["case"][came_from] != about["case"]).any()
    assert 60 < np.unique(came_from).size < 90, "about 63 % of them, with replacement"


def test_results_are_needed(script, tmp_path):
    outcome = CliRunner().invoke(
        script("resampled_verdicts").main, [str(tmp_path), "--output", str(tmp_path / "x.json")]
    )
    assert outcome.exit_code == 1
    assert outcome.output == f"Error: {tmp_path}: no tables/claims.csv there; make paper makes it\n"
    assert not (tmp_path / "x.json").exists()
