"""docs/ describes the files of a run, and its page on extensions works."""

import fnmatch
import re

import netCDF4

from support.documentation import ROOT, named_files, read
from support.output_files import documented
from support.workflow import TEST, copy_sources, snakemake
from viscorough_study.run.tables import read_table


def test_every_netcdf_file_is_described(finished):
    """The row of docs/output.md whose pattern matches a file gives its dimensions and variables, or its columns."""
    text = read(ROOT / "docs/output.md")
    rows, results = documented(text), finished / "results"
    lines, discs = rows["curves/lines/*/*.nc"], rows["curves/discs/*/*.nc"]
    same = [name for name in discs.variables if name not in ("rms_disc", "rms_square", "rms_ensemble")]
    rows["curves/lines/*/*.nc"] = lines._replace(variables=[*same, *lines.variables])
    described = set()
    for path in sorted(results.rglob("*.nc")):
        name = str(path.relative_to(results))
        if name.startswith("tables/"):
            assert f"### {path.stem}\n" in text, name
            continue
        (pattern,) = (pattern for pattern in rows if fnmatch.fnmatch(name, pattern))
        described.add(pattern)
        with netCDF4.Dataset(path) as file:
            for made in file.groups.values() or [file]:
                assert set(made.dimensions) == set(rows[pattern].dimensions), name
                variables, dimensions = set(made.variables), set(made.dimensions)
                assert variables - dimensions == set(rows[pattern].variables) - dimensions, name
    # The settings name no measured surfaces, and fine grids are a target of their own.
    not_there = {"curves/measured/*/*.nc", "surfaces/measured/*/*.nc", "curves/nested/*/*.nc"}
    not_there |= {"surfaces/discs/*/*.nc"}  # temporary
    assert described == {pattern for pattern in rows if "viscorough" not in pattern} - not_there


def test_extension_works_as_described(finished):
    """The test adds the table and the figure of docs/extending.md, with its files and rules."""
    copy_sources(finished)
    page = ROOT / "docs/extending.md"
    files = named_files(page)
    for name, rule in (("fits", "rule tabulate_departures:"), ("figures", "use rule plot_surfaces as plot_departures")):
        (text,) = re.findall(rf"```text\n({rule}.*?)```", read(page), re.DOTALL)
        with open(finished / f"workflow/rules/{name}.smk", "a", encoding="utf-8") as rules:
            rules.write(f"\n\n{text}")
    assert len(files) == 4
    for path, text in files.items():
        (finished / path).write_text(text, encoding="utf-8")
    snakemake(finished, *TEST, "--", "results/figures/departures.png")
    table = read_table(finished / "results/tables/departures.csv")
    assert set(table["hurst"]) <= {0.4, 0.9}
    assert len(table) > 0
    assert (finished / "results/figures/departures.png").stat().st_size > 1e4
