"""What a table of verdicts says of the scale at which they were found."""

from types import SimpleNamespace

import pytest
import xarray as xr

from support.workflow import ROOT
from viscorough_study.paper_data import number, read_paper
from viscorough_study.verdicts import attributes_of_scale

NUMBERS = read_paper(ROOT / "resources/paper", "numbers")


@pytest.mark.parametrize(("across", "trial"), [(257, 0), (129, 0), (127, 1), (33, 1)])
def test_attributes_of_scale(across, trial):
    evidence = SimpleNamespace(
        across=across,
        pooled={hurst: xr.Dataset(coords={"realization": range(count)}) for hurst, count in {0.1: 60, 0.9: 54}.items()},
        said=lambda section, name: number(NUMBERS, section, name),
    )
    about = attributes_of_scale(evidence)
    assert (about["elements_across"], about["paper_elements_across"], about["realizations"]) == (across, 257, 54)
    assert about["trial"] == trial
    assert ("mean nothing" in about["scale"]) == trial
