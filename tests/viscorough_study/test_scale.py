"""Whether a run is large enough to decide anything about the paper's claims."""

from types import SimpleNamespace

import pytest
import xarray as xr

from support.workflow import ROOT
from viscorough_study.paper_data import number, read_paper
from viscorough_study.scale import scale

NUMBERS = read_paper(ROOT / "resources/paper", "numbers")


@pytest.mark.parametrize(
    ("across", "realizations", "decisive"),
    [(257, {0.1: 54, 0.9: 60}, 1), (129, {0.1: 40}, 1), (33, {0.1: 720}, 0), (257, {0.1: 720, 0.9: 39}, 0)],
    ids=["default run", "half of the paper's", "coarse grid", "few discs of one exponent"],
)
def test_scale(across, realizations, decisive):
    evidence = SimpleNamespace(
        across=across,
        pooled={hurst: xr.Dataset(coords={"realization": range(count)}) for hurst, count in realizations.items()},
        said=lambda section, name: number(NUMBERS, section, name),
    )
    about = scale(evidence)
    assert (about["decisive"], about["elements_across"]) == (decisive, across)
    assert about["realizations"] == min(realizations.values())
    assert (about["paper_elements_across"], about["paper_realizations"]) == (257, 80)
    assert ("mean nothing" in about["scale"]) != decisive
