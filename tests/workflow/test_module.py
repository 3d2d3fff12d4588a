"""The workflow as a module of another workflow, and next to a library that was installed without the study."""

import os
import shutil
import site
import subprocess
import sys

import pytest

from support.command_line import python
from support.documentation import blocks
from support.workflow import (
    ROOT,
    copy_kernels,
    copy_project,
    copy_sources,
    environment,
    jobs,
    merged,
    plan,
    read_settings,
    snakemake,
)
from viscorough_study.run.tables import read_table

pytestmark = pytest.mark.long

OTHER = """
module viscorough:
    snakefile: "{snakefile}"
    config: {{"hurst": [0.4, 0.8], "discs": {{"elements": 33}}}}

use rule * from viscorough as rough_*
"""


def test_another_workflow_makes_a_figure_with_its_settings(finished_once, tmp_path):
    """Settings that the other workflow does not give have their defaults; files are in its folder."""
    copy_kernels(finished_once, tmp_path)
    (tmp_path / "Snakefile").write_text(OTHER.format(snakefile=ROOT / "Snakefile"))
    planned = jobs(snakemake(tmp_path, "--dry-run", "--", "rough_figure_4"))
    assert planned["rough_indent_surfaces"] == 2 * (2 + 1 + 1)  # readings A and B, and the control
    snakemake(tmp_path, "--", "rough_figure_1")
    assert (tmp_path / "results/figures/fig1_surfaces.png").stat().st_size > 5000


WITH_PREFIX = """
rule mine:
    output:
        "mine.txt"
    shell:
        "touch {{output}}"


module viscorough:
    snakefile: "{snakefile}"
    prefix: "rough"
    config: {settings}

use rule * from viscorough
"""


def test_module_leaves_the_default_target_to_rules_before_it(tmp_path):
    (tmp_path / "Snakefile").write_text(WITH_PREFIX.format(snakefile=ROOT / "Snakefile", settings={}))
    assert jobs(snakemake(tmp_path, "--dry-run")) == {"mine": 1}


def test_costs_count_only_the_run_under_any_prefix(finished, tmp_path):
    """Benchmark files left behind by other settings or targets do not count."""
    expected = read_table(finished / "results/tables/rule_costs.csv").set_index("rule")["jobs"]
    benchmarks = finished / "results/benchmarks"
    others = ("plot_media.tsv", "evaluate_measured.tsv", "earlier.tsv", "indent_surfaces/discs/h07000/0000-0001.tsv")
    for name in others:
        (benchmarks / name).parent.mkdir(exist_ok=True)
        shutil.copy(benchmarks / "judge_claims.tsv", benchmarks / name)
    (benchmarks / "compile_kernels.tsv").unlink()
    (finished / "results").rename(tmp_path / "results")
    (tmp_path / "rough").mkdir()
    (tmp_path / "results").rename(tmp_path / "rough/results")
    settings = merged(read_settings("config"), read_settings("test"))
    (tmp_path / "Snakefile").write_text(WITH_PREFIX.format(snakefile=ROOT / "Snakefile", settings=settings))
    options = ("--rerun-triggers", "mtime", "--forcerun", "tabulate_rule_costs", "--", "tabulate_rule_costs")
    assert plan(tmp_path, *options) == {"tabulate_rule_costs": 1}
    snakemake(tmp_path, *options)
    costs = read_table(tmp_path / "rough/results/tables/rule_costs.csv").set_index("rule")["jobs"]
    assert costs.to_dict() == expected.drop("compile_kernels").to_dict()


def test_module_of_the_documentation_is_planned(tmp_path):
    page = ROOT / "docs/reproduce.md"
    (text,) = (block.text for block in blocks(page) if block.text.startswith("module viscorough:"))
    (tmp_path / "viscorough").symlink_to(ROOT)
    (tmp_path / "Snakefile").write_text(text)
    planned = plan(tmp_path, "--", "rough_figure_1")
    assert planned.items() >= {"rough_generate_examples": 1, "rough_plot_surfaces": 1}.items()
    assert set(planned) <= {"rough_generate_examples", "rough_plot_surfaces", "rough_figure_1"}


def test_study_comes_from_the_checkout_of_the_workflow(tmp_path):
    """In a process that finds the library elsewhere and no study, rules and jobs take both from the checkout."""
    (tmp_path / "site").mkdir()
    (tmp_path / "site/viscorough").symlink_to(ROOT / "src/viscorough")
    (tmp_path / "Snakefile").write_text(
        f'include: "{ROOT}/workflow/rules/common.smk"\nimport viscorough\n'
        'print(os.environ["PYTHONPATH"], viscorough.__file__, cases.__file__, sep="\\n")\n'
        "rule all:\n    shell: 'true'\n"
    )
    script = f"""
import os, sys
os.chdir({str(tmp_path)!r})
sys.path[:] = [path for path in sys.path if not os.path.isdir(os.path.join(path, "viscorough_study"))]
from snakemake.cli import main
main(["--dry-run", "--quiet"])
"""
    done = python("-c", script, PYTHONPATH=str(tmp_path / "site"))
    source = ROOT / "src"
    expected = [f"{source}{os.pathsep}{tmp_path / 'site'}", f"{source}/viscorough/__init__.py"]
    assert done.stdout.splitlines()[:3] == [*expected, f"{source}/viscorough_study/run/cases.py"]


@pytest.fixture
def checkout(tmp_path):
    """Copy the project and its sources."""
    copy_project(tmp_path / "copy")
    copy_sources(tmp_path / "copy")
    return tmp_path / "copy"


def test_packages_of_another_checkout_are_refused(checkout):
    """After `cp -a`, .venv holds the path of the first checkout."""
    output = snakemake(checkout, "--dry-run", project=ROOT, fails=True)
    message = f"Error: this Snakemake uses viscorough of {ROOT}/src, not of this checkout, {checkout}/src; "
    assert output.splitlines()[-1].startswith(message)
    assert "Traceback" not in output
    assert "total" in snakemake(checkout, "--dry-run")


def test_module_with_packages_of_another_checkout_is_refused(checkout, tmp_path):
    (tmp_path / "Snakefile").write_text(OTHER.format(snakefile=checkout / "Snakefile"))
    output = snakemake(tmp_path, "--dry-run", project=ROOT, fails=True)
    assert output.splitlines()[-1].startswith(f"Error: this Snakemake uses viscorough of {ROOT}/src, not of this")


def test_workflow_without_sources_needs_packages_of_its_version(tmp_path):
    citation = copy_project(tmp_path / "copy") / "CITATION.cff"
    citation.write_text(citation.read_text().replace("version: 1.0.0\n", "version: 1.0.99\n"))
    output = snakemake(tmp_path / "copy", "--dry-run", fails=True)
    assert output.splitlines()[-1].endswith("is installed; version 1.0.99 is needed, as in CITATION.cff")


def test_interpreter_whose_path_has_a_space_is_refused(unmade, tmp_path):
    """Snakemake does not quote the path, so every job would fail."""
    interpreter = tmp_path / "my folder/python"
    interpreter.parent.mkdir()
    interpreter.symlink_to(sys.executable)
    variables = environment(unmade)
    variables["PYTHONPATH"] += os.pathsep + os.pathsep.join(site.getsitepackages())
    command = [interpreter, "-m", "snakemake", "--dry-run"]
    done = subprocess.run(command, cwd=unmade, env=variables, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1].startswith(f"Error: {interpreter}: the path of the Python interpreter has ' '")
    assert "Traceback" not in done.stderr
