"""The calculator of the page agrees with viscorough estimate, in Chromium."""

import re

import numpy as np
import pytest

from support.page import BROWSER, number_in, opened
from support.study import ROOT
from viscorough.viscous.estimate import estimate
from viscorough_study.page.calculator import calculator

FOLDER = ROOT / "workflow/page"


def mean_and_ends(estimated, name):
    """Return the mean over many surfaces at the only time, and the ends of its interval."""
    mean, error = getattr(estimated, name)[0], getattr(estimated.law, f"{name}_error")
    return [mean, mean * (1 - error), mean * (1 + error)]


def shown(tmp_path, **entered):
    """Return the text that the page shows for the entered values, in a browser without an error message."""
    events = "".join(
        f'document.querySelector("[name={name}]").value = "{value}";'
        f'document.querySelector("[name={name}]").dispatchEvent(new Event("input", {{bubbles: true}}));'
        for name, value in entered.items()
    )
    html = f"<!DOCTYPE html><meta charset=utf-8><title>-</title>{calculator(FOLDER)}<script>{events}</script>"
    (tmp_path / "page.html").write_text(html, encoding="utf-8")
    return re.search(r"<output [^>]*>(.*?)</output>", opened(tmp_path / "page.html"))[1]


@pytest.mark.skipif(BROWSER is None, reason="no Chromium is installed")
def test_page_agrees_with_the_command_and_explains_refusals(tmp_path):
    text = shown(tmp_path, hurst="0.7", rms="2", force="20")
    wanted = estimate(0.7, 2e-6, 0.01, 20.0, 1e9, [0.1])
    numbers = re.match(r"Depth (\S+) \[(\S+), (\S+)\] µm, velocity (\S+) \[(\S+), (\S+)\] µm/s", text).groups()
    expected = [number for name in ("depth", "velocity") for number in mean_and_ends(wanted, name)]
    assert [number_in(number)[0] for number in numbers] == pytest.approx(1e6 * np.array(expected), rel=5e-3)
    assert "is above its range: no estimate." in shown(tmp_path, time="1e6")
    assert "force F (N): a number above 0 is" in shown(tmp_path, force="")
