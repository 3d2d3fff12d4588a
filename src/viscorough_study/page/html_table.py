"""Tables as HTML pages, for a browser and for Snakemake's report."""

from pathlib import Path

import jinja2
import pandas as pd

from viscorough.io.datasets import read_dataset


def html_table(template, csv_path, nc_path):
    """HTML page with all rows of a table and the descriptions of its columns.

    template : text of the template; csv_path, nc_path : the table, as `run.tables.write_table` writes it
    """
    table, described = pd.read_csv(csv_path), read_dataset(nc_path)
    environment = jinja2.Environment(autoescape=True, trim_blocks=True)
    environment.filters["cell"] = _cell
    return environment.from_string(template).render(
        title=described.attrs["title"],
        csv=Path(csv_path).name,
        rows=list(table.itertuples(index=False, name=None)),
        columns=[(name, described[name].attrs) for name in table],
    )


def _cell(value):
    if pd.isna(value):
        return ""
    return f"{value:.4g}" if isinstance(value, float) else value
