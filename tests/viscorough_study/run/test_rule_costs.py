"""Costs of rules from benchmark files."""

import os
import re

import pytest

from viscorough_study.run.rule_costs import COLUMNS, rule_costs

HEADER = "s\th:m:s\tmax_rss\tmax_vms\n"


def test_jobs_are_summed_by_rule(tmp_path):
    (tmp_path / "indent/a").mkdir(parents=True)
    (tmp_path / "indent/a/0.tsv").write_text(HEADER + "10.0\t0:00:10\t200.0\t900\n")
    (tmp_path / "indent/b.tsv").write_text(HEADER + "30.0\t0:00:30\t100.4\t900\n")
    (tmp_path / "plot.tsv").write_text(HEADER + "0.5\t0:00:00\t-\t-\n")
    benchmarks = {"indent": [tmp_path / "indent/b.tsv", tmp_path / "indent/a/0.tsv"], "plot": [tmp_path / "plot.tsv"]}
    table = rule_costs(benchmarks | {"not made": [tmp_path / "missing.tsv"]})
    assert list(table) == list(COLUMNS)
    table = table.drop(columns="share_s")
    assert table.to_numpy().tolist() == [["indent", 2, 40.0, 30.0, 200.0], ["plot", 1, 0.5, 0.5, 0.0]]


def shares(folder, **jobs):
    """Return the shares of rules with these jobs, {rule: (time at the end, seconds)}."""
    for name, (end, seconds) in jobs.items():
        (folder / f"{name}.tsv").write_text(f"s\tmax_rss\n{seconds}\t\n")
        os.utime(folder / f"{name}.tsv", (end, end))
    table = rule_costs({name: [folder / f"{name}.tsv"] for name in jobs})
    return table.set_index("rule")["share_s"].to_dict()


def test_parallel_jobs_share_the_time_and_pauses_do_not_count(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "cpu_count", lambda: 4)
    times = shares(tmp_path, a=(1010, 10), b=(1012, 8), within=(1008, 2), next_day=(90000, 5))
    assert times == {"a": 6.67, "b": 4.67, "within": 0.67, "next_day": 5}
    assert sum(times.values()) == pytest.approx(12 + 5, abs=0.02)


def test_shares_of_a_copied_folder_sum_to_the_job_time_over_the_cores(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    assert sum(shares(tmp_path, a=(1000, 10), b=(1000, 12), c=(1000, 14)).values()) == pytest.approx(18, abs=0.02)


@pytest.mark.parametrize(
    "content",
    [b"", HEADER.encode(), b"s\th:m:s\n1\t0\n", b"\xff\xfe" + bytes(40), HEADER.encode() + b"-1.0\t0\t2.0\t3\n"],
    ids=["empty", "no job", "other columns", "bytes", "negative time"],
)
def test_error_names_a_damaged_file(tmp_path, content):
    (tmp_path / "plot.tsv").write_bytes(content)
    with pytest.raises(ValueError, match=rf"^{re.escape(str(tmp_path))}/plot.tsv: not a benchmark of a job; delete"):
        rule_costs({"plot": [tmp_path / "plot.tsv"]})


def test_without_files_the_table_has_no_rows(tmp_path):
    table = rule_costs({"plot": [tmp_path / "plot.tsv"]})
    assert (list(table), len(table)) == (list(COLUMNS), 0)
