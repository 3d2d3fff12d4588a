"""Files that must agree: profiles, rules and scripts, lock files, citation, container."""

import re
import tomllib

import yaml

from support.workflow import ROOT, RULES, TABLES, TEST, copy_project, jobs, plan, snakemake


def test_slurm_profile_gives_timed_jobs_a_node(tmp_path, finished_once):
    """Timed jobs have a node to themselves. The jobs equal those of a local run, except for the executor."""
    profile = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text())
    timed = {name for name, text in RULES.items() if "threads: ALL_CORES" in text}
    assert timed == set(profile["set-threads"])
    assert {profile["set-resources"][name]["slurm_extra"] for name in timed} == {"'--exclusive'"}
    assert profile.pop("executor") == "slurm"
    folder = copy_project(tmp_path)
    (folder / "local").mkdir()
    (folder / "local/config.yaml").write_text(yaml.safe_dump(profile))
    assert plan(folder, *TEST, "--profile", "local", "--", "all") == jobs((finished_once / "run.log").read_text())


def test_rules_scripts_tables_logs_and_benchmarks_share_their_names():
    """A rule is named by a verb and its table, or by the beginning that its tables have in common.

    Figures share one script. A rule that is derived from another one has its log and its benchmark.
    """
    for table, name in TABLES.items():
        noun = name.partition("_")[2]
        assert table == noun or table.startswith(f"{noun}_"), name
    scripts = {}
    for name, text in RULES.items():
        if '"results/logs/' in text:
            assert f'"results/logs/{name}' in text, name
            assert f'"results/benchmarks/{name}' in text, name
            assert "source=" in text, name
        if script := re.search(r'"\.\./scripts/(\w+)\.py"', text):
            scripts[name] = script[1]
    assert {name: script for name, script in scripts.items() if name != script} == {"plot_surfaces": "plot"}
    files = {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / "workflow/scripts").glob("*.py")}
    assert set(scripts.values()) == set(files)
    assert max(text.count("\n") for text in files.values()) <= 40


def test_every_rule_is_found_by_its_name(unmade):
    """Snakemake lists no rule that a loop or a function made."""
    listed = snakemake(unmade, "--list", cores=None)
    names = set(re.findall(r"^(\w+)(?: \(.*\))?$", listed, re.MULTILINE))
    assert names == set(RULES)


def test_lock_files_agree_with_each_other():
    """All are installed into one environment, so no package may be in two files. No file may hold an address."""
    texts = {path.name: path.read_text() for path in ROOT.glob("requirements*.lock")}
    packages = {name: set(re.findall(r"^([\w.-]+)==", text, re.MULTILINE)) for name, text in texts.items()}
    assert set(packages) == {"requirements.lock", "requirements-dev.lock", "requirements-slurm.lock"}
    assert sum(map(len, packages.values())) == len(set.union(*packages.values()))
    assert "://" not in "".join(texts.values())
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"] | {"": project["dependencies"]}
    for extra, requirements in extras.items():
        lock = "requirements-slurm.lock" if extra == "slurm" else "requirements-dev.lock"
        further = set() if extra in ("", "build", "study", "plot") else packages[lock]
        names = {re.match(r"[\w.-]+", requirement)[0].lower().replace("_", "-") for requirement in requirements}
        assert names <= packages["requirements.lock"] | further, extra


def test_citation_agrees_with_package_and_changelog():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert (citation["version"], citation["license"]) == (project["version"], project["license"])
    assert f"## {project['version']} ({citation['date-released']})\n" in (ROOT / "CHANGELOG.md").read_text()
