"""Verdicts on the paper's claims."""

import pandas as pd

from viscorough.io.atomic import atomic_write
from viscorough.io.datasets import read_dataset
from viscorough_study.job_log import log_to
from viscorough_study.tables import write_table
from viscorough_study.verdicts import COLUMNS, Evidence, judge, markdown


def main(discs, lines, scaling, validation, direct, csv, nc, verdicts, *, claims, **about):
    """Judge the claims by the ensembles and tables; about : further fields of Evidence."""
    of_hurst = {}
    for path in discs:
        ensemble = read_dataset(path)
        of_hurst.setdefault(ensemble["hurst"].item(), []).append(ensemble)
    evidence = Evidence(
        discs=dict(sorted(of_hurst.items())),
        lines={ds["hurst"].item(): ds for ds in map(read_dataset, lines)},
        scaling=pd.read_csv(scaling),
        validation=pd.read_csv(validation),
        direct=pd.read_csv(direct),
        **about,
    )
    table = judge(claims, evidence)
    write_table(table, csv, nc, columns=COLUMNS, dimension="verdict", title="Verdicts on the paper's claims")
    with atomic_write(verdicts) as temporary:
        temporary.write_text(markdown(table, claims), encoding="utf-8")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
