"""Costs of rules from benchmark files."""

from viscorough_study.rule_costs import COLUMNS, rule_costs

HEADER = "s\th:m:s\tmax_rss\tmax_vms\n"


def test_jobs_are_summed_up_by_rule(tmp_path):
    (tmp_path / "indent/a").mkdir(parents=True)
    (tmp_path / "indent/a/0.tsv").write_text(HEADER + "10.0\t0:00:10\t200.0\t900\n")
    (tmp_path / "indent/b.tsv").write_text(HEADER + "30.0\t0:00:30\t100.4\t900\n")
    (tmp_path / "plot.tsv").write_text(HEADER + "0.5\t0:00:00\t-\t-\n")
    table = rule_costs(tmp_path)
    assert list(table) == list(COLUMNS)
    assert table.to_numpy().tolist() == [["indent", 2, 40.0, 30.0, 200.0], ["plot", 1, 0.5, 0.5, 0.0]]


def test_without_benchmarks_there_are_no_rows(tmp_path):
    table = rule_costs(tmp_path)
    assert table.empty
    assert list(table) == list(COLUMNS)
