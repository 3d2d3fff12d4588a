"""Files for archives and catalogs say the same as CITATION.cff and pyproject.toml."""

import json
import re
import shutil
import subprocess
import tomllib

import yaml

from support.workflow import ROOT, snakemake


def test_codemeta_agrees_with_citation_and_package():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    codemeta = json.loads((ROOT / "codemeta.json").read_text())
    assert codemeta["name"] == citation["title"]
    assert codemeta["version"] == citation["version"] == project["version"]
    assert codemeta["datePublished"] == citation["date-released"].isoformat()
    assert f"## {project['version']} ({codemeta['datePublished']})\n" in (ROOT / "CHANGELOG.md").read_text()
    assert [f"Operating System :: POSIX :: {name}" for name in codemeta["operatingSystem"]] == [
        name for name in project["classifiers"] if name.startswith("Operating System")
    ]
    assert codemeta["license"] == f"https://spdx.org/licenses/{citation['license']}"
    assert citation["license"] == project["license"]
    assert codemeta["keywords"] == citation["keywords"]
    assert codemeta["description"] == project["description"]
    assert codemeta["runtimePlatform"] == f"Python {project['requires-python']}"
    assert [author["name"] for author in codemeta["author"]] == [author["name"] for author in citation["authors"]]
    assert len(codemeta["referencePublication"]) == len(citation["references"])
    for article, cited in zip(codemeta["referencePublication"], citation["references"], strict=True):
        assert article["name"] == cited["title"]
        assert article["@id"] == f"https://doi.org/{cited['doi']}"
        names = [(author["familyName"], author["givenName"]) for author in article["author"]]
        assert names == [(author["family-names"], author["given-names"]) for author in cited["authors"]]


def test_workflow_catalog():
    """It lists what has the two words in its README, and shows how to deploy what has these places and this file."""
    assert {"snakemake", "workflow"} <= set((ROOT / "README.md").read_text().lower().split())
    assert (ROOT / "workflow/Snakefile").exists()
    usage = yaml.safe_load((ROOT / ".snakemake-workflow-catalog.yml").read_text())["usage"]
    assert (ROOT / "config/README.md").exists()
    rules = "".join(path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk"))
    assert usage["software-stack-deployment"] == {"conda": True}
    assert rules.count(" conda:\n") == rules.count(" script:\n")
    assert usage["report"] == ("report(" in rules)


def test_the_container_has_what_its_commands_need(tmp_path):
    """The files that Containerfile copies suffice for plans of its commands."""
    commands = re.findall(r"^(COPY|RUN|CMD) (.*)", (ROOT / "Containerfile").read_text(), re.MULTILINE)
    for sources, target in (text.rsplit(maxsplit=1) for kind, text in commands if kind == "COPY"):
        for source in map(ROOT.joinpath, sources.split()):
            if source.is_dir():
                shutil.copytree(source, tmp_path / target, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
            else:
                (tmp_path / target).mkdir(exist_ok=True)
                shutil.copy(source, tmp_path / target)
    assert commands[-2:] == [("RUN", "make environment"), ("CMD", '["make", "reproduce"]')]
    for command in ("environment", "reproduce"):
        subprocess.run(["make", "--dry-run", command], cwd=tmp_path, check=True, capture_output=True)
    snakemake(tmp_path, "--dry-run")
