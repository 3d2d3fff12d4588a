"""The numbers that README and docs/ quote are those of the published tables."""

import json
import os
import re

import pandas as pd
import pytest

from support.benchmarks import load_benchmark
from support.documentation import README, ROOT, read, sections
from support.study import CLAIMS
from viscorough.reference import exponent_beta
from viscorough_study.verdicts import markdown

VERDICTS = ROOT / "docs/verdicts.md"
TABLE = pd.read_csv(ROOT / "docs/claims.csv")


def between_marks(page):
    return re.search(r"<!-- verdicts: .*? -->\n\n(.*?)\n<!-- end of verdicts -->", read(page), re.DOTALL)[1]


def of_claim(name):
    return TABLE[TABLE["claim"] == name].set_index("case")


def percent(ratios):
    return [round(100 * abs(end - 1)) for end in (ratios.min(), ratios.max())]


def test_pages_have_the_published_verdicts():
    """benchmarks/publish.py writes both."""
    assert list(dict.fromkeys(TABLE["claim"])) == list(CLAIMS)
    publish = load_benchmark("publish")
    assert between_marks(VERDICTS) == publish.verdicts()
    assert between_marks(VERDICTS).startswith(markdown(TABLE, CLAIMS))
    assert between_marks(README) == publish.verdict_lines()
    assert between_marks(README).count("\n") == len(CLAIMS) + 2


def test_prefactors():
    first, second = (of_claim(f"zeta_{name}") for name in ("elastic", "viscous"))
    low, high = percent(first["value"] / first["expected"])
    most, least = percent(second["value"] / second["expected"])
    assert f"ζ is {low} to {high} % above" in read(README)
    assert f"{least} to {most} % below the second" in read(README)
    assert f"*ζ* as defined here is {low} to {high} % above Eq. 4" in read(VERDICTS)


def test_exponents():
    law = pd.read_csv(ROOT / "src/viscorough/data/calibration.csv").query("source == 'discs'").set_index("hurst")
    above = [f"{law['beta'][hurst] - exponent_beta(hurst):.2f}" for hurst in (0.1, 0.4)]
    for page in ("verdicts", "verification"):
        text = " ".join(read(ROOT / f"docs/{page}.md").split())
        assert f"above *H*/(1 + *H*), by {above[0]} and {above[1]}" in text
    apart = of_claim("coincide")["value"].abs()
    assert apart[["H = 0.6", "H = 0.9"]].max() < 0.02
    assert f"by {apart['H = 0.1']:.2f} and {apart['H = 0.4']:.2f}" in read(ROOT / "docs/verification.md")


def test_gamma_factor():
    expected = of_claim("gamma")["expected"]
    text = " ".join(read(ROOT / "docs/verification.md").split())
    assert f"which would be {expected.min():.2f} to {expected.max():.2f}" in text
    low, high = percent(expected)
    assert f"changes *ζ* by {low} to {high} %" in " ".join(read(ROOT / "docs/theory.md").split())


def test_other_solvers():
    """The range in README.md is that of the table in docs/performance.md."""
    table = sections(ROOT / "docs/performance.md")["A disc by boundary elements"].split("ContactMechanics | Tamaas |")[
        1
    ]
    times = [
        float(cell) for row in re.findall(r"\| 0\.\d (\|.*)\|\n", table) for cell in row.split("|") if cell.strip()
    ]
    assert len(times) == 24
    assert f"take {min(times):.0f} to {10 * round(max(times) / 10)} times as long" in " ".join(read(README).split())


def test_published_files_say_where_they_come_from():
    folder = ROOT / "docs/results"
    if not folder.exists():
        pytest.skip("nothing is published yet")
    records = json.loads(read(folder / "published.json"))
    assert set(records) == {path.name for path in folder.iterdir()} - {"published.json"}
    assert sum(path.stat().st_size for path in folder.iterdir()) <= 3e6
    for name in load_benchmark("publish").PICTURES:
        if name in records:
            assert (folder / name).read_bytes() == (ROOT / "docs" / name).read_bytes()


def test_publishing(tmp_path):
    publish = load_benchmark("publish")
    results, project = tmp_path / "results", tmp_path / "project"
    for folder in ("tables", "figures"):
        (results / folder).mkdir(parents=True)
    for folder in ("docs", "src/viscorough/data"):
        (project / folder).mkdir(parents=True)
    for name in ("tables/claims.csv", "tables/calibration.csv", "tables/large.csv", "figures/speed.png", "seeds.csv"):
        (results / name).write_text(name)
    os.utime(results / "figures/speed.png", (86400 * 365.25 * 30,) * 2)
    publish.copy_verdicts(results, project)
    publish.copy_files(results, project, "abc")
    (results / "figures/speed.png").unlink()
    publish.copy_files(results, project, "def")
    kept = {str(path.relative_to(project)): path.read_text() for path in project.rglob("*.*")}
    records = json.loads(kept.pop("docs/results/published.json"))
    assert kept == {
        "docs/claims.csv": "tables/claims.csv",
        "docs/seeds.csv": "seeds.csv",
        "src/viscorough/data/calibration.csv": "tables/calibration.csv",
        "docs/results/large.csv": "tables/large.csv",
        "docs/results/speed.png": "figures/speed.png",
        "docs/speed.png": "figures/speed.png",
    }
    assert set(records) == {"large.csv", "speed.png"}
    assert records["large.csv"]["command"] == "make large"
    assert records["large.csv"]["commit"] == "def"
    assert records["speed.png"]["command"] == "make speed"
    assert records["speed.png"]["commit"] == "abc"
    assert records["speed.png"]["date"] == "2000-01-01"


def test_every_published_file_is_made_by_a_rule_or_a_benchmark():
    made = "\n".join(read(path) for path in [*(ROOT / "workflow/rules").glob("*.smk"), ROOT / "Makefile"])
    for command, names in load_benchmark("publish").PUBLISHED.items():
        assert re.search(rf"^{command.split()[1]}:", read(ROOT / "Makefile"), re.MULTILINE)
        for name in names:
            assert f"results/{name}" in made, name
