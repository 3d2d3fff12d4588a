"""Verdicts with different seeds."""

import pandas as pd
import seeds
from click.testing import CliRunner


def test_verdicts_that_change_with_the_seed_are_reported(tmp_path, monkeypatch):
    def claims(folder, seed, cores):
        verdicts = ["reproduced", "reproduced" if seed == 1 else "undecided"]
        return pd.DataFrame({"claim": ["steady", "unsteady"], "verdict": verdicts})

    monkeypatch.setattr(seeds, "claims", claims)
    output = tmp_path / "new/seeds.csv"
    outcome = CliRunner().invoke(seeds.main, ["--seeds", "2", "--output", str(output)])
    assert outcome.exit_code == 1
    assert "1 of 2 verdicts change with the seed" in outcome.output
    assert "unsteady  reproduced  undecided" in outcome.output
    assert pd.read_csv(output)["seed"].tolist() == [1, 1, 2, 2]
