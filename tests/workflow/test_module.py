"""The workflow as a module of another one, and beside a library that was installed without the study."""

import os

from support.command_line import python
from support.workflow import ROOT, copy_kernels, jobs, snakemake

OTHER = """
module viscorough:
    snakefile: "{snakefile}"
    config: {{"discs": {{"elements": 33, "hurst": [0.4, 0.8]}}, "lines": {{"hurst": [0.4, 0.8]}}}}

use rule * from viscorough as rough_*
"""


def test_another_workflow_makes_a_figure_with_settings_of_its_own(finished_once, tmp_path):
    """Settings that it does not give are the default ones; files lie in its folder."""
    copy_kernels(finished_once, tmp_path)
    (tmp_path / "Snakefile").write_text(OTHER.format(snakefile=ROOT / "workflow/Snakefile"))
    planned = jobs(snakemake(tmp_path, "--dry-run", "--", "rough_figure_4"))
    assert planned["rough_indent_surfaces"] == 2 * 2 + 2
    snakemake(tmp_path, "--", "rough_figure_1")
    assert (tmp_path / "results/figures/fig1_surfaces.png").stat().st_size > 5000


def test_the_study_comes_from_the_checkout_of_the_workflow(tmp_path):
    """In a process that finds the library elsewhere, and no study, rules and jobs take both from the checkout."""
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
