"""Results are copied completely or not at all, with their origin."""

import json
import os
import re
from pathlib import Path

import click
import pandas as pd
import publish
import pytest
from PIL import Image

from support.documentation import ROOT, read
from support.workflow import FIGURES
from support.workflow import TABLES as MADE
from viscorough_study.performance.methods import METHODS
from viscorough_study.run.tables import split_table, write_table


@pytest.fixture
def results(tmp_path):
    """Make a folder with everything that `make law` and `make large` make."""
    for name in [*publish.PUBLISHED["law"], *publish.PUBLISHED["large"], *publish.KEPT["law"]]:
        (tmp_path / "results" / name).parent.mkdir(parents=True, exist_ok=True)
        if name.endswith(".png"):
            Image.new("RGB", (3, 2)).save(tmp_path / "results" / name)
        else:
            columns = {"rule": ("rule", None), "share_s": ("time", "s")}
            write_table(
                pd.DataFrame({"rule": [name], "share_s": [60.0]}),
                tmp_path / "results" / name,
                columns=columns,
                title=name,
            )
    os.utime(tmp_path / "results/tables/law.csv", (86400 * 365.25 * 30,) * 2)
    return tmp_path / "results"


def test_only_complete_runs_are_published(results, tmp_path):
    """An incomplete run publishes nothing, for example a folder without the output of `make speed`."""
    for folder in ("docs", "resources/published", "src/viscorough/law/data"):
        (tmp_path / folder).mkdir(parents=True)
    with pytest.raises(click.ClickException, match="make speed"):
        publish.copy_results(results, tmp_path, ["law", "speed"], "abc")
    assert not list((tmp_path / "docs").iterdir())
    publish.copy_results(results, tmp_path, ["law"], "abc")
    publish.copy_results(results, tmp_path, ["large"], "def")
    records = json.loads((tmp_path / "docs/results/published.json").read_text())
    names = {name.split("/")[-1] for name in publish.PUBLISHED["law"] + publish.PUBLISHED["large"]}
    assert {path.name for path in (tmp_path / "docs/results").iterdir()} - {"published.json"} == set(records) == names
    assert records["law.csv"]["date"] == "2000-01-01"
    assert (records["large.csv"]["command"], records["large.csv"]["commit"]) == ("make large", "def")
    for name, target in publish.KEPT["law"].items():
        assert (tmp_path / target).read_text() == split_table(results / name)[1]


def test_published_files_state_their_origin():
    folder = ROOT / "docs/results"
    names = {path.name for path in folder.iterdir()} - {"published.json"}
    assert set(json.loads(read(folder / "published.json"))) == names
    assert sum(path.stat().st_size for path in folder.iterdir()) <= 3e6


def test_published_tables_have_the_methods_of_the_code():
    table = pd.read_csv(ROOT / "docs/results/methods.csv")
    assert set(table["method"]) == {method.name for method in METHODS}


def test_every_published_file_is_made_by_a_rule_or_a_benchmark():
    made = "\n".join(read(path) for path in [*(ROOT / "workflow/rules").glob("*.smk"), ROOT / "Makefile"])
    for command, names in publish.PUBLISHED.items():
        assert re.search(rf"^{command}:", read(ROOT / "Makefile"), re.MULTILINE)
        for name in names:
            assert Path(name).stem in FIGURES | MADE or f"results/{name}" in made, name
