"""Records of what a result is made with, in every kind of file."""

import pandas as pd
import pytest

from viscorough.io import netcdf
from viscorough_study.figures import style
from viscorough_study.run import made_with
from viscorough_study.run.made_with import all_versions, difference, origin, read_record, record_job
from viscorough_study.run.tables import write_table

PARAMS = {"seed": 1, "window": (0.1, 2), "text": "a (b) \\ c -- d", "long": ["x" * 5000], "source": "abc"}


@pytest.fixture(autouse=True)
def job(monkeypatch):
    """Record a job whose settings have characters that some files cannot hold as they are."""
    monkeypatch.setattr(made_with, "_RECORD", {})
    record_job("fit", ["results/a.nc"], PARAMS)


def write(path):
    """Write a file of the kind that its suffix says, with the functions of the scripts."""
    if path.suffix == ".nc":
        netcdf.write(path, {}, made_with.made_with_text())
    elif path.suffix == ".csv":
        write_table(pd.DataFrame({"beta": [0.5]}), path, columns={"beta": ("exponent", "1")}, title="Fits")
    elif path.suffix in (".png", ".pdf"):
        style.save_figure(style.new_figure(20), path)
    elif path.suffix == ".html":
        path.write_text(f"<html></html>{made_with.html_line()}")
    else:
        path.write_text(f"{made_with.text_line()}sphere\n")
    return path


@pytest.mark.parametrize("suffix", [".nc", ".csv", ".png", ".pdf", ".html", ".txt"])
def test_every_kind_of_file_states_the_record(tmp_path, suffix):
    path = write(tmp_path / f"a{suffix}")
    record = read_record(path)
    assert record["rule"] == "fit"
    assert record["settings"]["text"] == PARAMS["text"]
    assert record["settings"]["long"].startswith("sha256 ")
    assert "numpy" in record["versions"]
    assert difference(path, origin("fit", ["results/a.nc"], PARAMS)) is None
    assert difference(path, origin("fit", ["results/a.nc"], PARAMS | {"seed": 2})) == ("seed 1", "seed 2")
    assert difference(path, origin("fit", [], PARAMS)) == ('inputs ["results/a.nc"]', "inputs []")
    assert difference(path, origin("fit", ["results/a.nc"], PARAMS | {"source": "d"})) == ('source "abc"', 'source "d"')
    path.write_bytes(path.read_bytes()[:20])
    assert difference(path, origin("fit", ["results/a.nc"], PARAMS)) == ("no record", "a record")


def test_versions_of_all_jobs_before_are_recorded(tmp_path, monkeypatch):
    curves = write(tmp_path / "curves.nc")
    monkeypatch.setattr(made_with, "versions", lambda: {"numpy": "99.0"})
    record_job("fit", [curves], {})
    versions = read_record(write(tmp_path / "fits.csv"))["versions"]
    assert versions["numpy"][-1] == "99.0"
    assert len(versions["numpy"]) == 2
    assert all_versions([None, {"versions": {"numpy": ["1"]}}, {}]) == {"numpy": ["1"]}


def test_pdf_on_request_does_not_outlive_its_png(tmp_path):
    """A PDF file of the same job that is newer than the inputs, as requested together with the PNG file, is kept."""
    table = write(tmp_path / "fits.csv")
    record_job("plot", [table], PARAMS)
    pdf = write(tmp_path / "a.pdf")
    write(tmp_path / "a.png")
    assert pdf.exists()
    write(table)
    write(tmp_path / "a.png")
    assert not pdf.exists()
    record_job("plot", [table], PARAMS | {"seed": 2})
    write(pdf)
    record_job("plot", [table], PARAMS)
    write(tmp_path / "a.png")
    assert not pdf.exists()
