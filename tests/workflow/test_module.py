"""The workflow as a module of another workflow, and beside the packages of another checkout."""

import pytest

from support.workflow import (
    ROOT,
    copy_kernels,
    copy_project,
    copy_sources,
    jobs,
    snakemake,
)

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
