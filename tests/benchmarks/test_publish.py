"""What is published stands in the pages, says where it comes from, and is copied whole or not at all."""

import json
import os
import re
from pathlib import Path

import click
import numpy as np
import pandas as pd
import publish
import pytest
from PIL import Image

from support.documentation import README, ROOT, read
from support.study import CLAIMS
from support.workflow import FIGURES
from support.workflow import TABLES as MADE

PUBLISHED_CLAIMS = publish.published_claims()
TABLES = publish.tables()


@pytest.mark.parametrize(("page", "name"), TABLES)
def test_pages_have_the_published_tables(page, name):
    between = re.search(rf"<!-- {name}: .*? -->\n\n(.*?)\n<!-- end of {name} -->", read(ROOT / page), re.DOTALL)[1]
    assert between == TABLES[page, name]


def test_readme_has_every_claim_on_physics_and_first_the_time():
    physics = [claim["title"] for claim in CLAIMS.values() if claim["kind"] == "physics"]
    assert all(publish.verdict_lines().split("\n\n")[0].count(title) == 1 for title in physics)
    assert list(dict.fromkeys(PUBLISHED_CLAIMS["claim"])) == list(CLAIMS)
    assert read(README).index(publish.time_sentence()) < read(README).index("## ")


def test_sentences_on_other_scales_and_draws(monkeypatch):
    changed = PUBLISHED_CLAIMS.copy()
    monkeypatch.setattr(publish, "DEFAULT_CLAIMS", "default")
    monkeypatch.setattr(publish, "published_claims", lambda name="": changed if name else PUBLISHED_CLAIMS)
    assert publish.verdict_lines().endswith("those of `make paper` are the same.\n")
    changed.loc[changed["claim"] == "gamma", "verdict"] = "reproduced"
    changed.loc[changed["claim"] == "collapse", "verdict"] = "undecided"
    assert publish.verdict_lines().endswith("differ in: factor 1/Γ(2 − α).\n")
    sentence = publish.own_scale({"a": "x", "b": "y"}, {"a": "x", "b": "x"})
    assert sentence.endswith("but for: b (x).\n")


@pytest.fixture
def results(tmp_path):
    """A folder with all that `make paper`, `make large` and `make reproduce` make."""
    gradient = np.arange(2 * 3 * 3).reshape(2, 3, 3).astype(np.uint8)
    names = [*publish.PUBLISHED["paper"], *publish.PUBLISHED["large"]]
    for name in [*names, *publish.KEPT["paper"], *publish.KEPT["reproduce"]]:
        (tmp_path / "results" / name).parent.mkdir(parents=True, exist_ok=True)
        if name.endswith(".png"):
            Image.fromarray(gradient).save(tmp_path / "results" / name)
        else:
            (tmp_path / "results" / name).write_text(f"rule,share_s\n{name},60.0\n")
    os.utime(tmp_path / "results/tables/rule_costs.csv", (86400 * 365.25 * 30,) * 2)
    return tmp_path / "results"


@pytest.fixture
def project(tmp_path):
    """A project without anything published."""
    for folder in ("docs", "src/viscorough/data", "resources/published"):
        (tmp_path / "project" / folder).mkdir(parents=True)
    return tmp_path / "project"


def test_publishing(results, project):
    publish.copy_results(results, project, ["paper"], "abc")
    publish.copy_results(results, project, ["large"], "def")
    records = json.loads((project / "docs/results/published.json").read_text())
    names = {name.split("/")[-1] for name in publish.PUBLISHED["paper"] + publish.PUBLISHED["large"]}
    assert {path.name for path in (project / "docs/results").iterdir()} - {"published.json"} == set(records) == names
    assert records["rule_costs.csv"]["date"] == "2000-01-01"
    assert (records["large.csv"]["command"], records["large.csv"]["commit"]) == ("make large", "def")
    for name, target in publish.KEPT["paper"].items():
        assert (project / target).read_text() == (results / name).read_text()


def test_publishing_the_default_run(results, project):
    publish.copy_results(results, project, ["reproduce"], "abc")
    costs = pd.read_csv(project / publish.DEFAULT_COSTS)
    assert costs[["share_s", "measured"]].to_numpy().tolist() == [[60.0, "2000-01-01"]]
    assert costs["machine"].str.endswith("cores").all()
    assert (project / publish.DEFAULT_CLAIMS).read_text() == (results / "tables/claims.csv").read_text()


def test_nothing_is_published_of_an_incomplete_run(results, project):
    """As the charts of a small scale would be, of a folder in which `make speed` was not run."""
    with pytest.raises(click.ClickException, match="make speed"):
        publish.copy_results(results, project, ["speed"], "abc")
    assert not list((project / "docs").iterdir())


def test_times_of_other_solvers_are_kept_with_their_origin(tmp_path):
    published = pd.read_csv(ROOT / publish.OTHER_SOLVERS)
    measured = published.drop(columns=["measured", "machine"]).assign(wall_s=1.0)
    others = measured.iloc[:2].assign(solver=["viscorough", "Tamaas"], threads=[1, 2])
    pd.concat([others, measured]).to_csv(tmp_path / "other_solvers.csv", index=False)
    publish.copy_other_solvers(tmp_path / "other_solvers.csv", tmp_path / "kept.csv", "a machine", "2030-01-01")
    kept = pd.read_csv(tmp_path / "kept.csv")
    pd.testing.assert_frame_equal(kept, published.assign(measured="2030-01-01", machine="a machine"))


def test_published_files_say_where_they_come_from():
    folder = ROOT / "docs/results"
    names = {path.name for path in folder.iterdir()} - {"published.json"}
    assert set(json.loads(read(folder / "published.json"))) == names
    assert sum(path.stat().st_size for path in folder.iterdir()) <= 3e6
    assert all((folder / name).read_bytes() == (ROOT / "docs" / name).read_bytes() for name in publish.PICTURES)


def test_every_published_file_is_made_by_a_rule_or_a_benchmark():
    made = "\n".join(read(path) for path in [*(ROOT / "workflow/rules").glob("*.smk"), ROOT / "Makefile"])
    for command, names in publish.PUBLISHED.items():
        assert re.search(rf"^{command}:", read(ROOT / "Makefile"), re.MULTILINE)
        for name in names:
            assert Path(name).stem in FIGURES | MADE or f"results/{name}" in made, name
