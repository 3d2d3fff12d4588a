"""Judge the paper's claims, and write the verdicts as a table and as Markdown."""

from pathlib import Path

import pandas as pd

from viscorough.io.atomic import atomic_write
from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles.pool import select
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, write_table
from viscorough_study.verdicts.claims import COLUMNS, judge, markdown, scale_attributes
from viscorough_study.verdicts.evidence import Evidence


def main(discs, tables, csv, verdicts, *, claims, fine_grids, **settings):
    """Judge the claims by the loading curves of the base discs (group "base") and by tables, and write the verdicts.

    discs : file with the loading curves of discs of all groups; tables : CSV files, named after the tables
    csv, verdicts : files to write, the table and Markdown
    claims : content of resources/paper/claims.yaml; fine_grids : published rows from fits.fine_sentence.judged_rows
    settings : further fields of `Evidence`
    """
    evidence = Evidence(
        discs=select(read_dataset(discs), group="base"),
        tables={Path(path).stem: read_table(path) for path in tables} | {"fine_exponents": pd.DataFrame(fine_grids)},
        **settings,
    )
    table = judge(claims, evidence)
    attributes = scale_attributes(evidence)
    title = "Verdicts on the paper's claims" + f" ({attributes['scale']})" * attributes["trial"]
    write_table(table, csv, columns=COLUMNS, title=title, **attributes)
    with atomic_write(verdicts) as temporary:
        temporary.write_text(markdown(table, claims), encoding="utf-8")


run_job(globals(), main)
