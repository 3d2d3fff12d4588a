"""The calculator of the page agrees with viscorough estimate, in Chromium and, without a browser, in Node."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest

from support.page import BROWSER, Page, number_in, opened
from support.study import ROOT
from viscorough.law.calibrated_law import penetration_law
from viscorough.viscous.estimate import estimate
from viscorough_study.page.calculator import calculator, law_table

FOLDER = ROOT / "workflow/page"
SCRIPT = (FOLDER / "calculator.js").read_text(encoding="utf-8")
SECTION = (FOLDER / "calculator.html").read_text(encoding="utf-8")
NODE = shutil.which("node")
FIELDS = ("hurst", "rms", "diameter", "force", "viscosity", "time")


def random_cases(count):
    """Return values in SI units, with X inside and outside the range of the law."""
    random, cases = np.random.default_rng(1), []
    for _ in range(count):
        hurst, exponents = random.uniform(0.1, 1), random.uniform(-1, 1, 4)
        rms, diameter, force, viscosity = 10**exponents * [1e-6, 1e-2, 10, 1e8]
        law = penetration_law(hurst)
        x = np.exp(random.uniform(np.log(law.x_low / 1.5), np.log(law.x_high * 1.5)))
        cases.append((hurst, rms, diameter, force, viscosity, x * 4 * rms * diameter * viscosity / force))
    cases += [(hurst, 1e-6, 0.01, 10.0, 1e9, 0.1) for hurst in law_table()["hurst"]]
    return [dict(zip(FIELDS, map(float, case), strict=True)) for case in cases]


@pytest.mark.skipif(NODE is None, reason="Node is not installed")
def test_script_agrees_with_the_command():
    cases = random_cases(200)
    loop = f"""
        const table = {json.dumps(law_table())}, cases = {json.dumps(cases)};
        console.log(JSON.stringify(cases.map((one) => estimate(penetrationLaw(table, one.hurst), one))));
    """
    done = subprocess.run([NODE, "-e", SCRIPT + loop], capture_output=True, text=True, check=True)
    sides = set()
    for case, computed in zip(cases, json.loads(done.stdout), strict=True):
        sides.add(computed["where"])
        if computed["where"]:
            with pytest.raises(ValueError, match="where the law holds"):
                expected(case)
            continue
        wanted = expected(case)
        assert computed["x"] == pytest.approx(wanted.x[0], rel=1e-12)
        for name in ("depth", "velocity"):
            assert computed[name] == pytest.approx(mean_and_ends(wanted, name), rel=1e-10)
    assert sides == {"", "below", "above"}


def mean_and_ends(estimated, name):
    """Return the mean over many surfaces at the only time, and the ends of its interval."""
    mean, error = getattr(estimated, name)[0], getattr(estimated.law, f"{name}_error")
    return [mean, mean * (1 - error), mean * (1 + error)]


def expected(case):
    """Return the Estimate of the library."""
    return estimate(*(case[name] for name in FIELDS[:5]), [case["time"]])


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


def test_every_field_has_a_label_and_a_default():
    page = Page(SECTION)
    assert [field["name"] for field in page.attributes("input")] == list(FIELDS)
    assert len(page.attributes("label")) == len(FIELDS)
    assert all(float(field["value"]) > 0 for field in page.attributes("input"))
