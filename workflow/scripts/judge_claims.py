"""Verdicts on the paper's claims."""

import pandas as pd

from viscorough.io.atomic import atomic_write
from viscorough.io.datasets import read_dataset
from viscorough_study.job_log import log_to
from viscorough_study.pool import ensembles, select
from viscorough_study.tables import write_table
from viscorough_study.verdicts import COLUMNS, Evidence, judge, markdown


def main(discs, lines, scaling, validation, direct, csv, nc, verdicts, *, claims, **settings):
    """Judge the claims by the pools of discs and lines and by the tables; settings : further fields of Evidence."""
    base, lines = select(read_dataset(discs), group="base"), ensembles(read_dataset(lines), "hurst")
    exponents = sorted(set(base["hurst"].values.tolist()))
    evidence = Evidence(
        discs={hurst: list(ensembles(select(base, hurst=hurst), "case").values()) for hurst in exponents},
        lines={hurst: lines[hurst] for hurst in exponents},
        scaling=pd.read_csv(scaling),
        validation=pd.read_csv(validation),
        direct=pd.read_csv(direct),
        **settings,
    )
    table = judge(claims, evidence)
    write_table(table, csv, nc, columns=COLUMNS, dimension="verdict", title="Verdicts on the paper's claims")
    with atomic_write(verdicts) as temporary:
        temporary.write_text(markdown(table, claims), encoding="utf-8")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
