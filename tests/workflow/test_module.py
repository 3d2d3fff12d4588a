"""The workflow as a module of another one."""

from support.workflow import ROOT, jobs, snakemake

OTHER = """
module viscorough:
    snakefile: "{snakefile}"
    config: {{"discs": {{"elements": 33, "hurst": [0.4, 0.8]}}, "lines": {{"hurst": [0.4, 0.8]}}}}

use rule * from viscorough as rough_*
"""


def test_another_workflow_makes_a_figure_with_settings_of_its_own(tmp_path):
    """Settings that it does not give are the default ones; files lie in its folder."""
    (tmp_path / "Snakefile").write_text(OTHER.format(snakefile=ROOT / "workflow/Snakefile"))
    planned = jobs(snakemake(tmp_path, "--dry-run", "--", "rough_figure_4"))
    assert planned["rough_indent_surfaces"] == 2 * 2 + 2
    snakemake(tmp_path, "--", "rough_figure_1")
    assert (tmp_path / "results/figures/fig1_surfaces.png").stat().st_size > 5000
