"""A folder of scans to one table: the numbers of single files, in any order, continued after an interrupt."""

import re

import numpy as np
import pytest

import viscorough
from support import dying_process
from support.command_line import run, sphere_heights
from support.tables import read_table
from viscorough import contact_at, indent, self_affine_disc
from viscorough.cli import scans
from viscorough.cli.surface_options import HeightsFile

OPTIONS = "--force '10 uN,50 uN' --young '2 MPa'"


def surface(seed):
    return self_affine_disc(0.8, 17, rms=0.3, diameter=17, seed=seed, length_unit="um")


@pytest.fixture
def here(here):
    """Make a folder with scans/a.nc in um, b.nc in nm, and c.nc and d.csv, which are no maps."""
    (here / "scans").mkdir()
    viscorough.save(surface(1), "scans/a.nc")
    viscorough.save(surface(2).to("nm"), "scans/b.nc")
    (here / "scans/c.nc").write_text("no map")
    (here / "scans/d.csv").write_text("1,2\n")
    return here


def contact(names="a.nc b.nc c.nc", options="", output="table.csv"):
    """Return the exit code of viscorough contact for these files."""
    files = " ".join(f"scans/{name}" for name in names.split())
    return run(f"contact {files} {OPTIONS} {options} -o {output}")


def mark(path, row=0):
    """Change the number of patches in a row of a table."""
    lines = path.read_text().splitlines(keepends=True)
    first = next(i for i, line in enumerate(lines) if line.startswith("scans/")) + row
    lines[first] = re.sub(r",\d+,,,(\w+)$", r",777,,,\1", lines[first].rstrip("\n")) + "\n"
    path.write_text("".join(lines))


def test_a_folder_becomes_a_table_of_all_files_and_loads(here, capsys):
    """Python gives the same numbers, in um and N. A file that cannot be read has a reason, and the exit code is 3."""
    assert contact() == scans.SOME_FAILED
    printed = capsys.readouterr()
    assert printed.out == "table.csv: 4 rows of 3 files, 1 failed\n"
    assert re.fullmatch(r"viscorough contact: 1 of 3 files failed; the first is scans/c.nc: .*\n", printed.err)
    table, units = read_table("table.csv")
    assert table["file"].tolist() == ["scans/a.nc", "scans/a.nc", "scans/b.nc", "scans/b.nc", "scans/c.nc"]
    for seed, rows in ((1, table[:2]), (2, table[2:4])):
        expected = contact_at(surface(seed), force=["10 uN", "50 uN"], shear_modulus=2e6 / 3)
        np.testing.assert_allclose(rows["depth"], [each.depth for each in expected], rtol=1e-4)
        np.testing.assert_allclose(rows["normal_force"], [1e-5, 5e-5], rtol=1e-14)
        np.testing.assert_allclose(rows["normal_stiffness"], [each.normal_stiffness for each in expected], rtol=1e-3)
        areas = [each.corrected_contact_area for each in expected]
        np.testing.assert_allclose(rows["corrected_contact_area"], areas, rtol=1e-6)
        pressures = [2 / 3 * each.largest_pressure for each in expected]
        np.testing.assert_allclose(rows["largest_normal_pressure"], pressures, rtol=1e-2)
    assert "not readable" in table["error"].iloc[-1]
    assert [units[name] for name in ("depth", "normal_force", "contact_area")] == ["um", "N", "um2"]
    assert [path.name for path in here.iterdir() if path.suffix != ""] == ["table.csv"]


def test_the_table_depends_neither_on_jobs_nor_on_the_order_of_files(here):
    assert contact("a.nc b.nc", "--jobs 1", "one.csv") == 0
    assert contact("b.nc a.nc", "--jobs 2", "two.csv") == 0
    assert (here / "one.csv").read_bytes() == (here / "two.csv").read_bytes()


def test_only_changed_files_are_evaluated_again(here, capsys):
    contact("a.nc b.nc", "--jobs 1")
    table = here / "table.csv"
    for row in (0, 2):
        mark(table, row=row)
    assert table.read_text().count(",777,") == 2
    viscorough.save(surface(3), "scans/b.nc")
    capsys.readouterr()
    assert contact("b.nc a.nc") == 0
    assert capsys.readouterr().out == "table.csv: 4 rows of 2 files, 1 of them unchanged\n"
    patches = read_table("table.csv")[0].set_index("file")["patches"]
    assert (patches["scans/a.nc"] == 777).tolist() == [True, False]
    assert not (patches["scans/b.nc"] == 777).any()
    viscorough.save(surface(2).to("nm"), "scans/b.nc")
    assert contact("a.nc b.nc", "--tolerance 1e-4") == 0
    assert ",777," not in table.read_text()


def test_interrupted_run_leaves_the_finished_rows_and_continues(here, capsys, monkeypatch):
    whole = scans._each

    def interrupted(remaining, jobs):
        yield next(iter(whole(remaining, jobs)))
        raise KeyboardInterrupt

    monkeypatch.setattr(scans, "_each", interrupted)
    assert contact("a.nc b.nc") == 130
    captured = capsys.readouterr()
    assert (captured.out, len(captured.err.splitlines())) == ("", 1)
    assert "1 of 2 files are finished; the same command continues" in captured.err
    assert read_table("table.csv")[0]["file"].tolist() == ["scans/a.nc"] * 2
    mark(here / "table.csv")
    monkeypatch.setattr(scans, "_each", whole)
    assert contact("a.nc b.nc") == 0
    assert capsys.readouterr().out == "table.csv: 4 rows of 2 files, 1 of them unchanged\n"
    assert (here / "table.csv").read_text().count(",777,") == 1


@pytest.mark.filterwarnings("default")
def test_process_that_dies_leaves_the_reason_in_its_rows(here):
    jobs = []
    for points in (9, 5):
        np.save(f"{points}.npy", np.arange(points**2, dtype=float).reshape(points, points))
        opened = HeightsFile(here / f"{points}.npy", {"spacing": "1"})
        jobs.append(scans._Job(str(points), opened, "", dying_process.evaluate))
    results = {result.file: result for result in scans._each(jobs, 2)}
    assert results["9"].rows == [{"depth": 81.0}]
    assert "a process ended without a result" in results["5"].error


def test_single_file_gives_a_table_of_its_loads(here, capsys):
    """An error is reported with one line and no table, as by other commands."""
    assert contact("a.nc") == 0
    table, _ = read_table("table.csv")
    line = capsys.readouterr().out
    assert line.startswith(f"table.csv: 2 loads, the last at depth {table['depth'].iloc[-1]:.6g} um, F 5e-05 N, ")
    area, corrected = (table[name].iloc[-1] for name in ("contact_area", "corrected_contact_area"))
    assert f"contact area {area:.4g} um2 (corrected {corrected:.4g} um2), " in line
    assert contact("c.nc", output="other.csv") == 2
    assert not (here / "other.csv").exists()


def test_curves_of_a_folder_have_a_row_for_each_level(here):
    command = "indent scans/a.nc scans/b.nc --young '2 MPa' -o curves.csv"
    assert run(f"{command} --until-force '20 uN'") == 0
    table, units = read_table("curves.csv")
    curve = indent(surface(1), until_force="20 uN", until_fraction=1.0, shear_modulus=2e6 / 3)
    rows = table[table["file"] == "scans/a.nc"]
    np.testing.assert_allclose(rows["depth"], curve.depth, rtol=1e-12)
    np.testing.assert_allclose(rows["normal_force"], curve.force * 2e-6 / 3, rtol=1e-12)
    assert units["mean_normal_pressure"] == "MPa"
    assert run(f"{command} --forces '10 uN,50 uN'") == 0
    assert contact("a.nc") == 0
    curves, contacts = (read_table(name)[0].drop(columns="digest") for name in ("curves.csv", "table.csv"))
    assert curves[:2].drop(columns=["error", "warnings"]).equals(contacts.drop(columns=["error", "warnings"]))


@pytest.mark.parametrize(
    ("line", "what"),
    [
        (f"contact scans/a.nc scans/b.nc {OPTIONS} -o out.nc", "out.nc: 2 files of heights need a table"),
        (f"contact scans/a.nc scans/d.csv {OPTIONS} -o scans/d.csv", "would replace the heights"),
        (f"contact scans/a.nc scans/b.nc {OPTIONS} --crop 1 -o out.csv", "--crop 1: is not X0:X1,Y0:Y1"),
        (f"contact scans/a.nc scans/b.nc {OPTIONS} --poisson 0.3 --shear-modulus 1 -o out.csv", "exclude each other"),
        ("contact scans/a.nc scans/b.nc --force 5,1 -o out.csv", "each larger than the one before"),
        (f"contact scans/a.nc scans/b.nc {OPTIONS} -o out.xlsx", "unknown kind of file"),
    ],
)
def test_wrong_options_are_not_reported_as_errors_of_files(complaint, line, what):
    assert what in complaint(line)


def test_warnings_of_files_are_in_the_table(here, capsys):
    np.save("scans/steep.npy", 40 * sphere_heights(9))
    assert run("contact scans/steep.npy scans/a.nc --spacing 1 --unit um --depth 0.1 -o table.csv") == 0
    printed = capsys.readouterr()
    assert "warning: 1 of 2 files have warnings; the first is scans/steep.npy: the rms slope is" in printed.err
    table, _ = read_table("table.csv")
    (text,) = table[table["file"] == "scans/steep.npy"]["warnings"]
    assert text.startswith("the rms slope is ")
