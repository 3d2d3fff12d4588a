"""Tables as pages of HTML, which open in a browser and in Snakemake's report."""

import html

import pandas as pd

_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
body {{ font: 14px/1.4 system-ui, sans-serif; margin: 1.5em; color: #222; background: #fff; }}
h1 {{ font-size: 1.3em; }}
.wide {{ overflow-x: auto; }}
table {{ border-collapse: collapse; }}
th, td {{ padding: .2em .7em; text-align: left; vertical-align: top; border-bottom: 1px solid #ddd; }}
th {{ position: sticky; top: 0; background: #f4f4f4; }}
td.number {{ text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }}
dt {{ font-weight: 600; }}
dd {{ margin: 0 0 .3em 1.5em; }}
</style>
</head>
<body>
<h1>{title}</h1>
<p>{rows} rows. Numbers have four digits here, and all of their digits in <code>{csv}</code> beside this file.</p>
<div class="wide" tabindex="0">
<table>
<thead><tr>{header}</tr></thead>
<tbody>
{body}
</tbody>
</table>
</div>
<h2>Columns</h2>
<dl>
{columns}
</dl>
</body>
</html>
"""


def html_table(table, columns, title, csv_name):
    """A page with all rows of a tidy table (pandas.DataFrame) and the meaning of its columns.

    columns : {column: (long_name, units)}; csv_name : of the file with all digits, which the page names
    """
    kinds = [' class="number"' if table[name].dtype.kind in "iuf" else "" for name in columns]
    rows = zip(*(table[name].tolist() for name in columns), strict=True)
    body = (
        "<tr>" + "".join(f"<td{kind}>{_cell(value)}</td>" for kind, value in zip(kinds, row, strict=True)) + "</tr>"
        for row in rows
    )
    meanings = (
        f"<dt>{html.escape(name)}</dt><dd>{html.escape(long_name)}{_unit(units)}</dd>"
        for name, (long_name, units) in columns.items()
    )
    return _PAGE.format(
        title=html.escape(title),
        csv=html.escape(csv_name),
        rows=len(table),
        header="".join(f'<th scope="col">{html.escape(name)}</th>' for name in columns),
        body="\n".join(body),
        columns="\n".join(meanings),
    )


def _cell(value):
    if pd.isna(value):
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.4g}" if isinstance(value, float) else html.escape(str(value))


def _unit(units):
    return f" [{html.escape(units)}]" if units not in (None, "", "1") else ""
