"""The comparison of two runs finds every difference that has no reason, and names those that have one."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from click.testing import CliRunner

from support.study import LIMITS, ensemble, ensemble_of, pool_of, three_regions
from viscorough_study.conventions import in_every_reading
from viscorough_study.ensembles import abscissa
from viscorough_study.fit_table import fit_rows

X = abscissa(1e-6, 1, 10)


@pytest.fixture
def runs(tmp_path):
    """Two runs with the same numbers, in the layouts before and after the ensembles were pooled."""
    old, new = tmp_path / "old", tmp_path / "new"
    for folder in (old / "tables", new / "tables", old / "ensembles/discs", new / "ensembles"):
        folder.mkdir(parents=True)
    how = {"stiffness_range": (0.03, 0.3), "resamples": 20, "seed": 1, **LIMITS}
    kappa = three_regions(X) * np.array([[0.9], [1.0], [1.2]])
    fits = pd.DataFrame(fit_rows(ensemble_of(X, kappa), source="discs", case_group="base", **how))
    fits.to_csv(new / "tables/scaling.csv", index=False)
    in_every_reading(fits).to_csv(old / "tables/scaling.csv", index=False)
    claims = pd.DataFrame({"claim": ["beta"], "value": [0.3], "criterion": ["old words"]})
    claims.to_csv(old / "tables/claims.csv", index=False)
    claims.assign(criterion="new words").to_csv(new / "tables/claims.csv", index=False)
    one = ensemble(0.4, "h04000_c1", 1.0)
    one.to_netcdf(old / "ensembles/discs/h04000_c1.nc")
    pool_of([one]).to_netcdf(new / "ensembles/discs.nc")
    for run, name in ((old, "operators"), (new, "operator_applications")):
        (run / "curves/discs/h04000_c1").mkdir(parents=True)
        curves = xr.Dataset({"force": (("realization", "level"), np.ones((2, 3))), name: ("realization", [4, 5])})
        curves.assign_coords(realization=[0, 1]).to_netcdf(run / "curves/discs/h04000_c1/0000-0001.nc")
    return old, new


@pytest.fixture(scope="module")
def compared(script):
    """Exit code and output of the comparison of two runs."""

    def compare(runs):
        result = CliRunner().invoke(script("compare_tables").main, [str(run) for run in runs])
        return int(result.exit_code), result.output

    return compare


def test_equal_runs_and_their_exceptions(runs, compared):
    code, output = compared(runs)
    assert (code, "DIFFERENCE" in output) == (0, False)
    assert "0 unexplained differences" in output
    for exception in ("claims.csv, column criterion", "scaling.csv", "operators: operator_applications"):
        assert exception in output


@pytest.mark.parametrize(
    ("table", "column", "change", "message"),
    [
        ("scaling", "zeta_low_radius", lambda value: value * (1 + 1e-11), "scaling.csv, zeta_low: "),
        ("claims", "value", lambda value: value + 1e-6, "claims.csv, value: 1 of 1 numbers differ"),
        ("claims", "value", lambda value: value * np.nan, "by up to inf relative"),
        ("claims", "claim", lambda value: value + "x", "1 texts differ, first 'beta' and 'betax'"),
    ],
)
def test_a_difference_in_a_table(runs, compared, table, column, change, message):
    path = runs[1] / f"tables/{table}.csv"
    content = pd.read_csv(path)
    content.assign(**{column: change(content[column])}).to_csv(path, index=False)
    code, output = compared(runs)
    assert code == 1
    assert message in output


def test_differences_in_rounding_are_allowed(runs, compared):
    path = runs[1] / "tables/claims.csv"
    pd.read_csv(path).assign(value=0.3 * (1 + 1e-14)).to_csv(path, index=False)
    assert compared(runs)[0] == 0


def test_missing_and_other_files(runs, compared):
    (runs[1] / "tables/claims.csv").unlink()
    with xr.open_dataset(runs[1] / "ensembles/discs.nc") as pool:
        other = pool.load()
    other["stiffness"][0, 0, 5] *= 1.001
    other.to_netcdf(runs[1] / "ensembles/discs.nc")
    (runs[1] / "curves/discs/h04000_c1/0000-0001.nc").unlink()
    code, output = compared(runs)
    assert code == 1
    for difference in ("claims.csv: not in NEW", "ensemble discs/h04000_c1, stiffness: 1 of", "h04000_c1: not in NEW"):
        assert difference in output
