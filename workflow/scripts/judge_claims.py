"""Judge the claims, and write the verdicts as a table and as a page of the documentation."""

from pathlib import Path

import pandas as pd

from viscorough.io.atomic import atomic_write
from viscorough.io.datasets import read_dataset
from viscorough_study.fits.fine_sentence import fine_grids_sentence
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, write_table
from viscorough_study.verdicts.claims import COLUMNS, judge, scale_attributes
from viscorough_study.verdicts.document import document
from viscorough_study.verdicts.evidence import Evidence


def main(discs, tables, csv, verdicts, *, fine_grids, reduction, **settings):
    """Judge the claims by the loading curves of discs and by tables, and write the verdicts.

    discs : file with the loading curves of discs of all groups; tables : CSV files, named after the tables
    csv, verdicts : files to write, the table and a page in Markdown
    fine_grids, reduction : published rows that the default run does not make again, [{column: value}]: the limits of β
        (fits.fine_sentence.judged_rows), and the comparison of lines with discs (`compare_reduction`)
    settings : further fields of `Evidence`
    """
    made = {Path(path).stem: read_table(path) for path in tables}
    made |= {"fine_exponents": pd.DataFrame(fine_grids), "reduction": pd.DataFrame(reduction)}
    evidence = Evidence(discs=read_dataset(discs), tables=made, **settings)
    table = judge(evidence)
    attributes = scale_attributes(evidence)
    title = "Verdicts on the paper's claims" + f" ({attributes['scale']})" * attributes["trial"]
    write_table(table, csv, columns=COLUMNS, title=title, **attributes)
    with atomic_write(verdicts) as temporary:
        temporary.write_text(document(table, fine_grids_sentence(fine_grids)), encoding="utf-8")


run_job(globals(), main)
